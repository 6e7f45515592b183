#include "defects.h"

#include <fmt/core.h>

#include <algorithm>

namespace holdfast::cli {

std::string message_of(const Defect& defect) {
  switch (defect.kind) {
    case DefectKind::encloses_nothing:
      return defect.message + " (--keep box)";
    case DefectKind::outside_region:
      return defect.message + " (--keep bounded or --keep box; --drop-outside)";
    case DefectKind::inconsistent_orientation:
      return defect.message + " (--keep bounded)";
    default:
      return defect.message;
  }
}

bool is_valid(const std::vector<Defect>& defects) {
  return std::all_of(defects.begin(), defects.end(),
                     [](const Defect& d) { return d.kind >= DefectKind::encloses_nothing; });
}

std::string summary_text(const DefectSummary& summary) {
  std::string text;
  for (const DefectGroup& group : summary.groups) text += fmt::format("  {}\n", group.message);
  return text;
}

std::string list_text(const DefectSummary& summary, const std::vector<Defect>& defects, std::size_t most,
                      const char* rest) {
  std::string text;
  for (const DefectGroup& group : summary.groups) {
    std::size_t shown = 0, count = 0;
    const auto add = [&](const char* what, const std::string& message) {
      if (++count > most) return;
      ++shown;
      text += fmt::format("{}: {}\n", what, message);
    };
    if (group.cause == Cause::crack || group.cause == Cause::unwelded)
      for (const Gap& gap : summary.gaps)
        if (gap.open == (group.cause == Cause::crack)) add(gap.open ? "crack" : "unwelded", gap.message);
    for (const std::size_t i : group.defects) add(name(defects[i].kind), message_of(defects[i]));
    if (count > shown) text += fmt::format("... and {} more like these; {}\n", count - shown, rest);
  }
  return text;
}

}  // namespace holdfast::cli
