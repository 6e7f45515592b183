// Holdfast: what `repair` would need to be asked for to cure a surface.
#pragma once

#include "holdfast/export.h"
#include "holdfast/repair.h"
#include "holdfast/summary.h"
#include "holdfast/types.h"

namespace holdfast {

enum class CureKind {
  weld,        ///< RepairOptions::weld
  cut,         ///< no option: what crosses, touches or overlaps is cut
  fill_holes,  ///< RepairOptions::fill_holes
  unite,       ///< RepairOptions::unite
};
/// "weld", "cut", "fill holes", "unite"; stable.
[[nodiscard]] HOLDFAST_API const char* name(CureKind kind);

struct Cure {
  CureKind kind;
  std::size_t count =
      0;                 ///< of vertices to join, of defects, of holes; of parts that pass through each other
  double distance = 0;   ///< weld: the widest gap that is to be closed
  double tolerance = 0;  ///< weld: one significant digit, the smallest of those tried that closes all gaps
  std::size_t sides = 0;  ///< fill_holes: of the longest border
  std::size_t left = 0;   ///< fill_holes: borders that stay open, since a filling would meet the surface
};

struct Cures {
  std::vector<Cure> cures;  ///< in the order in which a repair does them
  /// Whether they were applied, all but `unite` together, and gave a valid surface without the gaps.
  bool tried = false;
  /// Whether the surface is valid as it is, so that what is proposed closes it.
  bool was_valid = false;
  /// Holes that no option closes: their fillings would meet the surface.
  std::size_t left_open = 0;
};

/// What cures a surface with such a summary, the one that `summarise` gives of its defects.
///
/// Each proposal is applied before it is made, unless that would take more new points than `most_points`:
/// then it is a guess, and `tried` is false. To unite parts is a matter of what is meant, so it is proposed
/// wherever they pass through each other. Holes are those that are left after the rest. Limits are those of
/// `options`, whose other members are not looked at; throws Interrupted for them.
[[nodiscard]] HOLDFAST_API Cures propose_cures(const Complex& complex, std::span<const Defect> defects,
                                               const DefectSummary& summary,
                                               const RepairOptions& options = {});

}  // namespace holdfast
