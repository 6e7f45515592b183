// The boundary of a point's cavity: its faces, their vertices in an order of their own, and their edges, each
// of which two faces share.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/change.h"
#include "mesh/tet_mesh.h"
#include "refine/tuning.h"

namespace holdfast {

/// A face of the boundary; the point p sees it with orient(v0, v1, v2, p) > 0. Side i < 3 is the edge
/// opposite corner i.
struct RimFace {
  std::array<Vertex, 3> v;
  std::array<std::uint32_t, 3> local;  ///< places in the ring
  Face outer;                          ///< the same face from outside
  Flags flags;                         ///< of the new tetrahedron (v0 v1 v2 p)
};

/// The vertices of the boundary, each with its place.
class RimVertices {
 public:
  /// Of a mesh with so many vertices: none.
  void clear(std::size_t vertex_count) {
    if (place_.size() < vertex_count) place_.resize(vertex_count + vertex_count / 2, 0);
    ring_.clear();
  }
  /// The place of a vertex, which is added if it has none.
  std::uint32_t add(Vertex v) {
    if (!has(v)) {
      place_[v] = static_cast<std::uint32_t>(ring_.size());
      ring_.push_back(v);
    }
    return place_[v];
  }
  [[nodiscard]] bool has(Vertex v) const { return place_[v] < ring_.size() && ring_[place_[v]] == v; }
  /// Of a vertex that has one.
  [[nodiscard]] std::uint32_t place(Vertex v) const { return place_[v]; }
  [[nodiscard]] std::size_t size() const { return ring_.size(); }
  [[nodiscard]] std::span<const Vertex> all() const { return ring_; }

 private:
  std::vector<Vertex> ring_;
  std::vector<std::uint32_t> place_;  // by vertex: position in the ring, if the ring holds it there
};

/// The edges of the boundary, which is closed: it holds each of them both ways.
class RimEdges {
 public:
  void list(std::span<const RimFace> rim, const RimVertices& vertices);
  /// Whether ab is one of those that were listed.
  [[nodiscard]] bool has(std::span<const RimFace> rim, const RimVertices& vertices, Vertex a, Vertex b) const;
  /// Links the new tetrahedra, of which number k stands on face k, at the edges that were listed.
  void link(std::span<const RimFace> rim, const RimVertices& vertices, std::span<NewTet> new_tets);

 private:
  [[nodiscard]] static bool fits_table(const RimVertices& vertices) {
    return vertices.size() <= tuning::kMostInTable;
  }
  void link_by_table(std::span<const RimFace> rim, std::size_t side, std::span<NewTet> new_tets) const;
  void link_by_ends(std::span<NewTet> new_tets);
  void list_by_ends(std::span<const RimFace> rim, std::size_t vertex_count);
  // The end of an edge, both given by their places, at which it is listed.
  [[nodiscard]] std::uint32_t end_of(std::uint32_t u, std::uint32_t w) const {
    return degree_[u] < degree_[w] || (degree_[u] == degree_[w] && u < w) ? u : w;
  }

  // By the places of an edge's two vertices: 4 * face + side. Entries of other boundaries stay: who reads one
  // compares.
  std::vector<std::uint32_t> table_;
  // Where there are too many vertices for the table: an edge is listed at the end that has fewer, so that no
  // list is long, however many edges one vertex has.
  struct Side {
    std::uint32_t other;  // the end at which it is not listed
    Face face;            // of a new tetrahedron, or kNone once it is linked
  };
  std::vector<std::uint32_t> degree_, first_,
      next_;  // by place: its edges, its first side, the one to be listed next
  std::vector<Side> sides_;
};

}  // namespace holdfast
