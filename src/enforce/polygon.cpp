#include "enforce/polygon.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "numbers/vector.h"

namespace holdfast {
namespace {

// Twice the area over the longest side's square: a guide, never a decision.
double shape(const TetMesh& mesh, Vertex a, Vertex b, Vertex c) {
  Vector u{};
  Vector v{};
  Vector w{};
  exact::difference(mesh.point(b), mesh.point(a), u.data());
  exact::difference(mesh.point(c), mesh.point(a), v.data());
  exact::difference(mesh.point(c), mesh.point(b), w.data());
  const double longest = std::max({dot(u, u), dot(v, v), dot(w, w)});
  return longest > 0 ? length(cross(u, v)) / longest : 0;
}

class EarClipper {
 public:
  EarClipper(const TetMesh& mesh, std::span<const Vertex> polygon, Vertex above)
      : mesh_(mesh), above_(above), rest_(polygon.begin(), polygon.end()), corners_(polygon.size()) {}

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
  struct Corner {
    bool turn_known = false;
    bool convex = false;
    double rank = kUnknown;  // shape of the ear
  };
  static constexpr double kUnknown = -1;
  static constexpr double kNoEar = -2;

  [[nodiscard]] int turn(Vertex a, Vertex b, Vertex c) const { return mesh_.orient(a, b, c, above_); }

  [[nodiscard]] std::array<Vertex, 3> corner(std::size_t k) const {
    const std::size_t n = rest_.size();
    return {rest_[(k + n - 1) % n], rest_[k], rest_[(k + 1) % n]};
  }

  bool convex(std::size_t k) {
    Corner& c = corners_[k];
    if (!c.turn_known) {
      const auto [u, v, w] = corner(k);
      c.convex = turn(u, v, w) > 0;
      c.turn_known = true;
    }
    return c.convex;
  }

  // If a chain enters the triangle of a convex corner, its foremost point there is a corner that is not
  // convex. So only such corners are tested.
  bool is_ear(std::size_t k) {
    if (!convex(k)) return false;
    const auto [a, b, c] = corner(k);
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      const Vertex v = rest_[i];
      if (v == a || v == b || v == c || convex(i)) continue;
      if (turn(c, a, v) >= 0 && turn(a, b, v) >= 0 && turn(b, c, v) >= 0) return false;
    }
    return true;
  }

  void rank(std::size_t k) {
    const auto [a, b, c] = corner(k);
    corners_[k].rank = is_ear(k) ? shape(mesh_, a, b, c) : kNoEar;
  }

  // A best ear exists. A simple polygon, with its flat corners, has a triangulation without flat triangles:
  // at a strictly convex corner, either the diagonal between its neighbours is free, or the one to the corner
  // in its closed triangle that is farthest from that diagonal. With more than three corners, the
  // triangulation has two triangles with two sides on the border.
  std::size_t best_ear() {
    std::size_t best = find_best();
    if (best == rest_.size()) {  // clipping an ear may have made other ears than its neighbours
      for (Corner& c : corners_) c.rank = kUnknown;
      best = find_best();
    }
    if (best == rest_.size()) throw std::logic_error("holdfast: a polygon has no ear");
    return best;
  }

  std::size_t find_best() {
    std::size_t best = rest_.size();
    for (std::size_t k = 0; k < rest_.size(); ++k) {
      if (corners_[k].rank == kUnknown) rank(k);
      if (corners_[k].rank != kNoEar && (best == rest_.size() || corners_[k].rank > corners_[best].rank))
        best = k;
    }
    return best;
  }

  void clip(std::size_t k) {
    rest_.erase(rest_.begin() + static_cast<std::ptrdiff_t>(k));
    corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(k));
    const std::size_t n = rest_.size();
    corners_[k % n] = {};
    corners_[(k + n - 1) % n] = {};
  }

  const TetMesh& mesh_;
  Vertex above_;
  std::vector<Vertex> rest_;
  std::vector<Corner> corners_;
};

}  // namespace

std::vector<std::array<Vertex, 3>> triangulate_polygon(const TetMesh& mesh, std::span<const Vertex> polygon,
                                                       Vertex above) {
  if (polygon.size() < 3) throw std::logic_error("holdfast: a polygon of fewer than three corners");
  return EarClipper(mesh, polygon, above).run();
}

}  // namespace holdfast
