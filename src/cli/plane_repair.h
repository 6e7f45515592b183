// A repair before the triangles: `holdfast plane --repair`.
#pragma once

#include <string>

#include "holdfast/plane_repair.h"

namespace holdfast::cli {

/// Repairs the planes of a file; `weld` is the T of --repair=T. Throws UsageError.
[[nodiscard]] PlanesRepair repair_planes(const PlanesInSpace& planes, double weld, const Limits& limits);

/// One sentence for the end of a run.
[[nodiscard]] std::string summary_of(const PlaneRepairReport& report);

/// Whether a repair removes some of these defects.
[[nodiscard]] bool are_repairable(const std::vector<Defect>& defects);

}  // namespace holdfast::cli
