// Parts of a mesh that threads change at the same time, in place.
//
// Every vertex belongs to one part. Tetrahedra with vertices of several parts are mixed: they stay, and their
// faces and edges with all vertices in one part are treated as facets and segments. So
//   1. tetrahedra of different parts have no vertex in common, nor are they neighbours;
//   2. code that changes a part and respects constraints writes only its tetrahedra and vertices, and
//      in mixed tetrahedra only neighbours across faces whose vertices are the part's;
//   3. it reads nothing that another part writes, even in a walk round a vertex.
// Marks of searches (mark_visited) are the exception: mixed tetrahedra must not be marked, so balls of their
// vertices (is_at_mixed) must be gathered without marks.
//
// Unlike with refine/parts.h, nothing is copied, but tetrahedra at the cuts cannot change. The parts, and so
// the results, do not depend on the number of threads.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/parallel.h"
#include "mesh/slot_pools.h"
#include "mesh/tet_mesh.h"

namespace holdfast {

class InPlaceParts {
 public:
  using PartNumber = SlotPools::Pool;

  /// These tetrahedra, which facets part from all others, in as many parts; `part_of` is by vertex. Each part
  /// gets free slots for `spare` more tetrahedra at least.
  InPlaceParts(TetMesh& mesh, std::span<const Tet> tets, const std::vector<PartNumber>& part_of,
               std::size_t count, std::size_t spare, const Threads& threads);
  /// The mesh is whole again.
  ~InPlaceParts();
  InPlaceParts(const InPlaceParts&) = delete;
  InPlaceParts& operator=(const InPlaceParts&) = delete;

  /// SlotPools::kNoPool for a mixed one and for those of nobody.
  [[nodiscard]] PartNumber part_of(Tet t) const { return pools_.pool_of(t); }
  [[nodiscard]] const std::vector<Tet>& mixed() const { return mixed_; }
  /// By vertex: whether it is one of a mixed tetrahedron.
  [[nodiscard]] const std::vector<std::uint8_t>& at_mixed() const { return at_mixed_; }
  /// Free slots of a part.
  [[nodiscard]] std::size_t spare(std::size_t part) const { return pools_.spare(part); }

 private:
  struct HeldEdge {
    Tet tet;  // a mixed one
    int edge;
  };
  void find_mixed(std::span<const Tet> tets, const std::vector<PartNumber>& part_of, const Threads& threads);
  void hold(const std::vector<PartNumber>& part_of);

  TetMesh& mesh_;
  SlotPools pools_;
  std::vector<Tet> mixed_;
  std::vector<std::uint8_t> at_mixed_;
  std::vector<Face> held_faces_;
  std::vector<HeldEdge> held_edges_;
};

}  // namespace holdfast
