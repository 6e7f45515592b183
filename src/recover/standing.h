// Which constraints stand: segments that are one edge, facets that are one face.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/parallel.h"
#include "mesh/tet_mesh.h"
#include "surface/complex.h"

namespace holdfast {

/// One flag per segment of the table and one per facet.
struct Standing {
  std::vector<std::uint8_t> segments, facets;

  [[nodiscard]] std::size_t missing_segments() const;
  [[nodiscard]] std::size_t missing_facets() const;
};

/// What a mesh has to conform to, and what of it stands. The references must outlive it.
struct ConstraintSet {
  const SegmentTable& table;
  std::span<const Triangle> facets;
  Standing& standing;
};

/// Finds the segments and facets that the mesh holds and sets their bits there. One sweep over the
/// tetrahedra.
[[nodiscard]] Standing mark_present(TetMesh& mesh, const SegmentTable& table, const Threads& threads = 1);

}  // namespace holdfast
