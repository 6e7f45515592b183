// The last part of the paper's §6.4: once no tetrahedron is negative or null, elements are made better, by
// the improver of meshes with field points.
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

/// All tetrahedra must be positive. Constraints and fixed vertices stand, vertices keep their numbers and new
/// ones come last. None of the figures of the mesh (optimise/figures.h) gets worse.
ImprovedTangle improve_tangle(Tangle& tangle, const exact::DoubleGrid& grid, std::uint64_t seed,
                              Monitor& monitor);

}  // namespace holdfast
