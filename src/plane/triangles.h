// A mesh of triangles in the plane: corners, neighbours and which edges are constraints.
//
//            v[0]
//            /  \        Edge i of a triangle lies opposite to corner i, from v[i + 1] to v[i + 2]; corners
//     e[2]  /    \ e[1]  turn left. The code 4 t + i is edge i of triangle t; `across` of it is the code of
//          /      \      the same edge in the triangle on its other side.
//      v[1]--------v[2]
//            e[0]
//
// A mesh of a whole convex hull is closed: beyond each edge of the hull lies a ghost triangle, whose third
// corner is the vertex at infinity, kNoVertex. In other meshes nothing lies across border edges.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "plane/points.h"

namespace holdfast::plane {

using EdgeCode = std::uint32_t;
inline constexpr EdgeCode kNoEdge = ~EdgeCode{0};

[[nodiscard]] inline std::uint32_t triangle_of(EdgeCode e) { return e >> 2; }
[[nodiscard]] inline std::uint32_t edge_of(EdgeCode e) { return e & 3; }
[[nodiscard]] inline EdgeCode code(std::size_t triangle, std::uint32_t edge) {
  return static_cast<EdgeCode>(triangle << 2) | edge;
}
/// The edge, or corner, after edge e in its triangle, counterclockwise.
[[nodiscard]] inline EdgeCode next_edge(EdgeCode e) { return edge_of(e) == 2 ? e - 2 : e + 1; }
[[nodiscard]] inline EdgeCode previous_edge(EdgeCode e) { return edge_of(e) == 0 ? e + 2 : e - 1; }

/// Called from time to time in long loops with the share of work done; may throw.
using Poll = std::function<void(double)>;

struct alignas(32) Corners {
  std::array<Vertex, 3> v;
  std::array<EdgeCode, 3> across;
  std::uint32_t constrained = 0;  ///< bit i: edge i is a constraint
  std::uint32_t mark = 0;
};

class Triangles {
 public:
  [[nodiscard]] std::size_t size() const { return all_.size(); }
  [[nodiscard]] const Corners& operator[](std::size_t t) const { return all_[t]; }
  [[nodiscard]] Corners& operator[](std::size_t t) { return all_[t]; }
  LargeVector<Corners>& all() { return all_; }

  [[nodiscard]] bool is_ghost(std::size_t t) const {
    const std::array<Vertex, 3>& v = all_[t].v;
    return v[0] == kNoVertex || v[1] == kNoVertex || v[2] == kNoVertex;
  }
  [[nodiscard]] EdgeCode across(EdgeCode e) const { return all_[triangle_of(e)].across[edge_of(e)]; }
  /// The corner opposite an edge, and the edge's ends.
  [[nodiscard]] Vertex apex(EdgeCode e) const { return all_[triangle_of(e)].v[edge_of(e)]; }
  [[nodiscard]] Vertex from(EdgeCode e) const { return apex(next_edge(e)); }
  [[nodiscard]] Vertex to(EdgeCode e) const { return apex(previous_edge(e)); }
  [[nodiscard]] bool constrained(EdgeCode e) const {
    return (all_[triangle_of(e)].constrained >> edge_of(e) & 1) != 0;
  }
  /// Marks an edge as a constraint, seen from both sides.
  void constrain(EdgeCode e);
  void join(EdgeCode e, EdgeCode f) {
    all_[triangle_of(e)].across[edge_of(e)] = f;
    if (f != kNoEdge) all_[triangle_of(f)].across[edge_of(f)] = e;
  }

  /// Exchanges the diagonal of the quadrilateral round an edge, which must be strictly convex:
  ///
  ///        b              b         Edge e = (a, b) with p on its left and q on its right. Afterwards its
  ///      / | \          / u \       triangle is (p, a, q), and (q, b, p) the other one; the new diagonal is
  ///     p t|u q   ->   p-----q      edge 1 of both.
  ///      \ | /          \ t /
  ///        a              a
  void flip(EdgeCode e);

  /// Sets, for each vertex, a triangle at it.
  void find_stars(std::size_t vertices);
  /// Some edge whose first end is `v`, or kNoEdge for a vertex without triangles. Needs find_stars.
  [[nodiscard]] EdgeCode edge_from(Vertex v) const;
  /// The edge ab, seen from its left, or kNoEdge. Needs a closed mesh and find_stars.
  [[nodiscard]] EdgeCode find_edge(Vertex a, Vertex b) const;
  /// The next edge from the same vertex, clockwise, or kNoEdge at a border.
  [[nodiscard]] EdgeCode turn_right(EdgeCode e) const {
    const EdgeCode other = across(e);
    return other == kNoEdge ? kNoEdge : next_edge(other);
  }
  /// Prefetches for a vertex: first the number of its triangle, then the triangle.
  void fetch_star(Vertex v) const { __builtin_prefetch(&star_[v]); }
  void fetch_triangle(Vertex v) const {
    if (const std::uint32_t t = star_[v]; t != kNoVertex) __builtin_prefetch(&all_[t]);
  }
  void fetch(std::uint32_t triangle) const { __builtin_prefetch(&all_[triangle]); }
  void set_star(Vertex v, std::uint32_t triangle) { star_[v] = triangle; }
  void add_star(std::uint32_t triangle) { star_.push_back(triangle); }
  void drop_stars(std::size_t count) { star_.resize(count); }

 private:
  void touch(std::uint32_t t) {
    for (const Vertex v : all_[t].v)
      if (v != kNoVertex) star_[v] = t;
  }

  LargeVector<Corners> all_;
  LargeVector<std::uint32_t> star_;  // empty until find_stars
};

}  // namespace holdfast::plane
