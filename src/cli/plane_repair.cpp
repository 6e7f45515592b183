#include "plane_repair.h"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "command.h"
#include "limits.h"
#include "summary.h"

namespace holdfast::cli {

PlanesRepair repair_planes(const PlanesInSpace& planes, double weld, const Limits& limits) {
  RepairOptions options;
  static_cast<Limits&>(options) = limits;
  options.weld = weld;
  options.progress = goes_on;
  try {
    return repair(planes, options);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("--repair={}: {}", weld, error.what()));
  }
}

std::string summary_of(const PlaneRepairReport& report) {
  if (report.changes_nothing()) return "the segments are valid as they are";
  std::string text;
  const auto tell = [&](std::size_t count, const char* one, const char* many) {
    if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, one, many);
  };
  tell(report.cut_segments, "segment cut", "segments cut");
  tell(report.left_out_segments, "segment left out", "segments left out");
  tell(report.new_points, "new point", "new points");
  tell(report.joined_points, "point joined to others", "points joined to others");
  tell(report.moved_points, "point moved", "points moved");
  return text + fmt::format("; at most {:.3g} from the input", report.max_displacement);
}

bool are_repairable(const std::vector<Defect>& defects) {
  return std::any_of(defects.begin(), defects.end(), [](const Defect& defect) {
    switch (defect.kind) {
      case DefectKind::vertex_in_segment:
        return !defect.vertices.empty();  // no hole or seed
      case DefectKind::repeated_vertex:
      case DefectKind::degenerate_segment:
      case DefectKind::segments_cross:
      case DefectKind::segments_overlap:
        return true;
      default:
        return false;
    }
  });
}

}  // namespace holdfast::cli
