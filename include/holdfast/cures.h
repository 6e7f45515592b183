// Holdfast: the `repair` options that would cure a surface.
#pragma once

#include "holdfast/export.h"
#include "holdfast/repair.h"
#include "holdfast/summary.h"
#include "holdfast/types.h"

namespace holdfast {

enum class CureKind {
  weld,        ///< RepairOptions::weld
  cut,         ///< no option: facets that cross, touch or overlap are cut
  fill_holes,  ///< RepairOptions::fill_holes
  unite,       ///< RepairOptions::unite
  join,        ///< RepairOptions::weld and, for faces, RepairOptions::join, with the same tolerance
};
/// "weld", "cut", "fill holes", "unite", "join"; stable.
[[nodiscard]] HOLDFAST_API const char* name(CureKind kind);

struct Cure {
  CureKind kind;
  /// Number of vertices to join, of defects, of holes; of parts that pass through each other; of triangles,
  /// or pairs of edges, that nearly touch another body.
  std::size_t count = 0;
  double distance = 0;  ///< weld: the widest gap to close; join: the largest distance of what nearly touches
  /// weld, join: the smallest tolerance tried that closes all of these, to one significant digit.
  double tolerance = 0;
  std::size_t sides = 0;   ///< fill_holes: of the longest border
  std::size_t left = 0;    ///< fill_holes: borders that stay open because a filling would meet the surface
  bool has_faces = false;  ///< join: triangles nearly touch, not edges alone
};

struct Cures {
  std::vector<Cure> cures;  ///< in the order in which a repair applies them; what is left to the user last
  /// Whether all cures but `unite` and `join` were applied together and gave a valid surface without the
  /// gaps.
  bool tried = false;
  /// Whether the surface is already valid. The cures then only close it.
  bool was_valid = false;
  /// Holes that no option closes because their fillings would meet the surface.
  std::size_t left_open = 0;
};

/// The cures of a surface. `summary` is what `summarise` returns for its defects.
///
/// Each cure is applied before it is proposed, unless that would take too many new points (src/api/cures.cpp
/// has the limit). The proposal is then a guess, and `tried` is false. Holes are counted after all other
/// cures.
///
/// Two cures depend on what the user means. `unite` is proposed wherever parts pass through each other.
/// `join` is proposed, also for a valid surface, if bodies (sets of triangles connected by sides) come within
/// a millionth of the extent of each other, and none does any more after such a repair.
///
/// Only the limits of `options` are used. Throws Interrupted for them.
[[nodiscard]] HOLDFAST_API Cures propose_cures(const Complex& complex, std::span<const Defect> defects,
                                               const DefectSummary& summary,
                                               const RepairOptions& options = {});

}  // namespace holdfast
