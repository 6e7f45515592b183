// Enforces constraints that flips left missing: partition and elimination (paper §5, §6; docs/concepts.md).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "enforce/partition.h"
#include "holdfast/intermediate.h"
#include "mesh/monitor.h"
#include "mesh/tet_mesh.h"
#include "recover/standing.h"
#include "surface/complex.h"

namespace holdfast {

struct EnforceOptions {
  std::uint64_t seed = 0;
  bool flips = true;      ///< try flips again before a constraint is cut: points nearby make room for them
  bool cavities = true;   ///< with flips: fill the cavities of a facet again before it is cut
  bool eliminate = true;  ///< false: partition points stay on their constraints (`--stop-after partition`)
  LayingOrder order = LayingOrder::random;
};

struct EnforceStats {
  std::size_t segment_points = 0;  ///< partition points put on segments, of the cavities of facets too
  std::size_t facet_points = 0;    ///< partition points put inside facets, of these cavities' faces too
  ConstraintPieces pieces;         ///< if they are not eliminated
};

/// Makes every facet one face and every segment one edge of the mesh, by partition and elimination. Points
/// moved off the constraints are suppressed or recentred along the way.
///
/// All constraints stand afterwards. Vertices 0 .. first_free-1 are the input's and the box's. In exact
/// arithmetic this cannot fail on a valid complex. Throws Interrupted through the monitor.
EnforceStats enforce(TetMesh& mesh, const ConstraintSet& constraints, Vertex first_free,
                     const EnforceOptions& options, Monitor& monitor);
}  // namespace holdfast
