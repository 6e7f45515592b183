// Which regions stay in the volume, and their ids (design §2.6).
#pragma once

#include <span>
#include <vector>

#include "classify/regions.h"
#include "holdfast/holdfast.h"
#include "surface/complex.h"

namespace holdfast {

struct Kept {
  std::vector<bool> region;     ///< by region of Regions: whether it stays
  std::vector<int> id;          ///< by region: the id that users see
  std::vector<Defect> defects;  ///< encloses_nothing, outside_region; empty when all is well
};

/// Applies keep rule, holes and region seeds of the options, then looks for constraints left outside.
///
/// Throws std::invalid_argument for a hole or region seed that lies on the surface or outside every
/// bounded region.
[[nodiscard]] Kept choose_regions(TetMesh& mesh, const Regions& regions, const Complex& complex,
                                  const SegmentTable& table, const Options& options);

}  // namespace holdfast
