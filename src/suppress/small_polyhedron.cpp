#include "suppress/small_polyhedron.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

#include "mesh/measure.h"

namespace holdfast {
namespace {

using Local = std::uint8_t;
using LocalFace = std::array<Local, 3>;

// Rotated so that the least corner comes first: equal faces of equal orientation are equal.
LocalFace canonical(LocalFace f) {
  if (f[1] < f[0] && f[1] < f[2]) return {f[1], f[2], f[0]};
  if (f[2] < f[0] && f[2] < f[1]) return {f[2], f[0], f[1]};
  return f;
}

class Search {
 public:
  Search(const TetMesh& mesh, std::span<const std::array<Vertex, 3>> faces, const PolyhedronOptions& options)
      : mesh_(mesh), budget_(options.most_nodes) {
    if (faces.size() > 2 * options.most_vertices) return;  // Euler: a sphere on n vertices has 2 n - 4
    for (const auto& f : faces) vertices_.insert(vertices_.end(), f.begin(), f.end());
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    if (vertices_.size() > options.most_vertices) return;
    n_ = vertices_.size();
    sign_.assign(n_ * n_ * n_ * n_, kUnknown);
    apexes_.assign(n_ * n_ * n_, kUnknownMask);
    for (const auto& f : faces) open_.push_back(canonical({local(f[0]), local(f[1]), local(f[2])}));
  }

  std::optional<std::vector<TetMesh::Corners>> run() {
    if (n_ == 0 || !fill()) return std::nullopt;
    std::vector<TetMesh::Corners> tets;
    for (const auto& t : tets_)
      tets.push_back({vertices_[t[0]], vertices_[t[1]], vertices_[t[2]], vertices_[t[3]]});
    return tets;
  }

 private:
  static constexpr std::int8_t kUnknown = 2;
  static constexpr std::uint32_t kUnknownMask = 0x80000000u;  // a polyhedron has at most 31 vertices

  [[nodiscard]] Local local(Vertex v) const {
    return static_cast<Local>(std::lower_bound(vertices_.begin(), vertices_.end(), v) - vertices_.begin());
  }

  int orient(Local a, Local b, Local c, Local d) {
    if (a == b || a == c || a == d || b == c || b == d || c == d) return 0;
    std::array<Local, 4> k{a, b, c, d};
    bool odd = false;
    for (std::size_t i = 1; i < 4; ++i)
      for (std::size_t j = i; j > 0 && k[j - 1] > k[j]; --j) {
        std::swap(k[j - 1], k[j]);
        odd = !odd;
      }
    std::int8_t& s = sign_[((k[0] * n_ + k[1]) * n_ + k[2]) * n_ + k[3]];
    if (s == kUnknown)
      s = static_cast<std::int8_t>(
          mesh_.orient(vertices_[k[0]], vertices_[k[1]], vertices_[k[2]], vertices_[k[3]]));
    return odd ? -s : s;
  }

  [[nodiscard]] bool is_open(const LocalFace& canonical_face) const {
    return std::find(open_.begin(), open_.end(), canonical_face) != open_.end();
  }

  // A tetrahedron that holds another vertex of the polyhedron in its closure cannot be part of a filling.
  bool is_empty(const LocalFace& f, Local d) {
    for (Local x = 0; x < n_; ++x) {
      if (x == f[0] || x == f[1] || x == f[2] || x == d) continue;
      if (orient(f[0], f[1], f[2], x) >= 0 && orient(f[0], d, f[1], x) >= 0 &&
          orient(f[1], d, f[2], x) >= 0 && orient(f[2], d, f[0], x) >= 0)
        return false;
    }
    return true;
  }

  // The vertices that make a positive, empty tetrahedron with the face, one bit each.
  std::uint32_t apexes(const LocalFace& f) {
    std::uint32_t& mask = apexes_[(f[0] * n_ + f[1]) * n_ + f[2]];
    if (mask == kUnknownMask) {
      mask = 0;
      for (Local d = 0; d < n_; ++d)
        if (orient(f[0], f[1], f[2], d) > 0 && is_empty(f, d)) mask |= 1u << d;
    }
    return mask;
  }

  // The fattest tetrahedron first.
  std::vector<Local> ranked(const LocalFace& f, std::uint32_t mask) const {
    std::vector<std::pair<double, Local>> order;
    for (; mask != 0; mask &= mask - 1) {
      const auto d = static_cast<Local>(std::countr_zero(mask));
      order.emplace_back(
          -fatness(mesh_, vertices_[f[0]], vertices_[f[1]], vertices_[f[2]], mesh_.point(vertices_[d])), d);
    }
    std::sort(order.begin(), order.end());
    std::vector<Local> out;
    for (const auto& [fat, d] : order) out.push_back(d);
    return out;
  }

  // Takes the open face with the fewest possible apexes.
  bool fill() {
    if (open_.empty()) return true;
    if (budget_ == 0) return false;
    --budget_;
    LocalFace face{};
    int fewest = 32;
    for (const LocalFace& f : open_) {
      const int count = std::popcount(apexes(f));
      if (count == 0) return false;
      if (count >= fewest) continue;
      fewest = count;
      face = f;
    }
    for (const Local apex : ranked(face, apexes(face))) {
      const std::vector<LocalFace> before = open_;
      if (place(face, apex)) {
        tets_.push_back({face[0], face[1], face[2], apex});
        if (fill()) return true;
        tets_.pop_back();
      }
      open_ = before;
    }
    return false;
  }

  // Covers `f` with the tetrahedron (f, d): its other faces close open ones or open new ones.
  bool place(const LocalFace& f, Local d) {
    std::erase(open_, f);
    for (std::size_t k = 0; k < 3; ++k) {
      const LocalFace own = canonical({f[(k + 1) % 3], f[k], d});   // as the tetrahedron's inside sees it
      const LocalFace rest = canonical({f[k], f[(k + 1) % 3], d});  // as what is left to fill sees it
      if (is_open(own)) {
        std::erase(open_, own);
      } else {
        if (is_open(rest)) return false;
        open_.push_back(rest);
      }
    }
    return true;
  }

  const TetMesh& mesh_;
  std::size_t budget_;
  std::size_t n_ = 0;
  std::vector<Vertex> vertices_;
  std::vector<std::int8_t> sign_;      // by ascending corners
  std::vector<std::uint32_t> apexes_;  // by canonical face
  std::vector<LocalFace> open_;        // seen positively from what is left to fill
  std::vector<std::array<Local, 4>> tets_;
};

}  // namespace

std::optional<std::vector<TetMesh::Corners>> fill_polyhedron(const TetMesh& mesh,
                                                             std::span<const std::array<Vertex, 3>> faces,
                                                             const PolyhedronOptions& options) {
  return Search(mesh, faces, options).run();
}

}  // namespace holdfast
