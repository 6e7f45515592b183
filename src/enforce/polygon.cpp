#include "enforce/polygon.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace holdfast {
namespace {

using Vector = std::array<double, 3>;

double squared(const Vector& a) { return a[0] * a[0] + a[1] * a[1] + a[2] * a[2]; }

// Twice the area over the longest side's square: a guide, never a decision.
double shape(const TetMesh& mesh, Vertex a, Vertex b, Vertex c) {
  Vector u{};
  Vector v{};
  Vector w{};
  exact::difference(mesh.point(b), mesh.point(a), u.data());
  exact::difference(mesh.point(c), mesh.point(a), v.data());
  exact::difference(mesh.point(c), mesh.point(b), w.data());
  const Vector n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const double longest = std::max({squared(u), squared(v), squared(w)});
  return longest > 0 ? std::sqrt(squared(n)) / longest : 0;
}

class EarClipper {
 public:
  EarClipper(const TetMesh& mesh, std::span<const Vertex> polygon, Vertex above)
      : mesh_(mesh), above_(above), rest_(polygon.begin(), polygon.end()), rank_(polygon.size(), kUnknown) {}

  std::vector<std::array<Vertex, 3>> run() {
    std::vector<std::array<Vertex, 3>> triangles;
    while (rest_.size() > 3) {
      const std::size_t k = best_ear();
      triangles.push_back(corner(k));
      clip(k);
    }
    if (turn(rest_[0], rest_[1], rest_[2]) <= 0) throw std::logic_error("holdfast: a polygon ends flat");
    triangles.push_back({rest_[0], rest_[1], rest_[2]});
    return triangles;
  }

 private:
  static constexpr double kUnknown = -1;
  static constexpr double kNoEar = -2;

  [[nodiscard]] int turn(Vertex a, Vertex b, Vertex c) const { return mesh_.orient(a, b, c, above_); }

  [[nodiscard]] std::array<Vertex, 3> corner(std::size_t k) const {
    const std::size_t n = rest_.size();
    return {rest_[(k + n - 1) % n], rest_[k], rest_[(k + 1) % n]};
  }

  [[nodiscard]] bool is_ear(std::size_t k) const {
    const auto [a, b, c] = corner(k);
    if (turn(a, b, c) <= 0) return false;
    return std::none_of(rest_.begin(), rest_.end(), [&, a = a, b = b, c = c](Vertex v) {
      return v != a && v != b && v != c && turn(a, b, v) >= 0 && turn(b, c, v) >= 0 && turn(c, a, v) >= 0;
    });
  }

  std::size_t best_ear() {
    std::size_t best = rest_.size();
    for (std::size_t k = 0; k < rest_.size(); ++k) {
      if (rank_[k] == kUnknown) {
        const auto [a, b, c] = corner(k);
        rank_[k] = is_ear(k) ? shape(mesh_, a, b, c) : kNoEar;
      }
      if (rank_[k] != kNoEar && (best == rest_.size() || rank_[k] > rank_[best])) best = k;
    }
    if (best == rest_.size()) throw std::logic_error("holdfast: a polygon has no ear");
    return best;
  }

  // Only corners whose triangle held the clipped vertex can turn into ears besides its two neighbours;
  // those are not tracked, so every corner that is no ear is looked at again.
  void clip(std::size_t k) {
    rest_.erase(rest_.begin() + static_cast<std::ptrdiff_t>(k));
    rank_.erase(rank_.begin() + static_cast<std::ptrdiff_t>(k));
    const std::size_t n = rest_.size();
    rank_[k % n] = kUnknown;
    rank_[(k + n - 1) % n] = kUnknown;
    for (double& r : rank_)
      if (r == kNoEar) r = kUnknown;
  }

  const TetMesh& mesh_;
  Vertex above_;
  std::vector<Vertex> rest_;
  std::vector<double> rank_;
};

}  // namespace

std::vector<std::array<Vertex, 3>> triangulate_polygon(const TetMesh& mesh, std::span<const Vertex> polygon,
                                                       Vertex above) {
  if (polygon.size() < 3) throw std::logic_error("holdfast: a polygon of fewer than three corners");
  return EarClipper(mesh, polygon, above).run();
}

}  // namespace holdfast
