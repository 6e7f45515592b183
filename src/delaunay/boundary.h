// The boundary of a cavity as the new vertex sees it: its faces, each with the new cell on it, and its
// vertices with local numbers, so that edges fit into a small table (the reconnection of HXT: Marot,
// Pellerin, Remacle 2019).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/slots.h"
#include "delaunay/triangulation.h"

namespace holdfast {

struct CavityFace {
  Face outer;
  std::array<Vertex, 3> v;             // (new vertex, v) is positive
  std::array<std::uint32_t, 3> local;  // the same vertices as places in the ring
  Tet slot;
};

class CavityBoundary {
 public:
  /// `ghost_scratch` is the site in which the ghost's place is kept.
  explicit CavityBoundary(Vertex ghost_scratch);

  /// Takes the boundary of a cavity whose cells are about to be removed. Gives a slot to each face, the
  /// cavity's own slots first, and lists the faces, each linked to its outer neighbour. The code of the face
  /// of a new cell at boundary edge (i, j) goes into `table` at i * side + j, if there are at most `side`
  /// vertices; true if so.
  bool take(Triangulation& triangulation, std::span<const Face> cavity, std::span<const Face> rim,
            Slots& slots, std::span<Face> table, std::uint32_t side);
  /// Makes the vertices relative to the new one.
  void look_from(const Triangulation& triangulation, const double* p);

  [[nodiscard]] std::span<const CavityFace> faces() const { return {faces_.data(), face_count_}; }
  [[nodiscard]] std::span<const Vertex> vertices() const { return {ring_.data(), ring_count_}; }
  /// Of each vertex.
  [[nodiscard]] const Spoke* spokes() const { return spokes_.data(); }

 private:
  void give_slots(std::span<const Face> cavity, Slots& slots);
  template <bool kByTable>
  void list(Triangulation& triangulation, std::span<const Face> rim, Face* table, std::uint32_t side);

  const Vertex ghost_scratch_;
  // Kept to allocate nothing. The counts say how much of each array is in use.
  std::vector<CavityFace> faces_;
  std::vector<Vertex> ring_;
  std::vector<Spoke> spokes_;
  std::size_t face_count_ = 0;
  std::uint32_t ring_count_ = 0;
};

}  // namespace holdfast
