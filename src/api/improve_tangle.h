// The last part of the paper's §6.4: when no tetrahedron is negative or null, elements are improved as in
// meshes with field points.
#pragma once

#include <cstdint>

#include "mesh/monitor.h"
#include "optimise/figures.h"
#include "optimise/improve.h"
#include "untangle/tangle.h"

namespace holdfast {

struct ImprovedTangle {
  ImproveStats stats;
  Figures before, after;
};

/// All tetrahedra must be positive. Constraints and fixed vertices stay, vertices keep their numbers, and new
/// ones come last. No figure of the mesh (optimise/figures.h) gets worse.
ImprovedTangle improve_tangle(Tangle& tangle, const exact::DoubleGrid& grid, std::uint64_t seed,
                              Monitor& monitor);

}  // namespace holdfast
