// Holdfast: an exact check of what `repair` promises, independent of how it repairs.
#pragma once

#include "holdfast/export.h"
#include "holdfast/limits.h"
#include "holdfast/repair.h"
#include "holdfast/types.h"

namespace holdfast {

/// Claims about a repaired surface: the lists of a RepairResult, or of the files that `holdfast repair`
/// writes. Indices are those of the input and of the output.
struct RepairClaims {
  IndexLists parents;                         ///< by facet of the output, facets of the input
  std::optional<IndexLists> segment_parents;  ///< no value: unknown
  std::vector<RepairResult::Moved> moved;
  std::vector<RepairResult::Dropped> dropped;
  std::optional<std::vector<RepairResult::Merged>> merged;  ///< no value: unknown
  /// No value: unknown. Facets without parents then count as fillings.
  std::optional<std::vector<RepairResult::Filled>> filled;
  std::map<int, std::vector<int>> marker_sets;
  double max_displacement = 0;
  /// The options of the repair that change valid surfaces, too. No value: unknown.
  std::optional<double> weld, join;
  std::optional<bool> unite;
};

[[nodiscard]] HOLDFAST_API RepairClaims claims_of(const RepairResult& result, const RepairOptions& options);

/// The rules of the promise of `repair`, in the order in which a check lists them. The numbers are stable.
enum class RepairRuleKind : int {
  output_valid = 1,       ///< a simplicial complex: elements meet only in common vertices and sides
  vertices_kept = 2,      ///< all input vertices not listed as moved have the same bits
  distances_right = 3,    ///< every listed distance is right for its vertex, and at most `max_displacement`
  parents_named = 4,      ///< every facet has parents that exist, or fills a hole
  children_near = 5,      ///< every facet lies within the largest distance of each of its parents
  parents_covered = 6,    ///< every input facet lies within the largest distance of its children
  segments_covered = 7,   ///< the same for segments, both ways
  losses_listed = 8,      ///< every input facet without children is listed as dropped, with the true reason
  repeats_listed = 9,     ///< facets with the same corners are listed as merged
  fillings_bounded = 10,  ///< facets without parents close the holes that are listed
  markers_kept = 11,      ///< each facet's marker stands for those of its parents
  valid_unchanged = 12,   ///< a valid surface is unchanged
};
/// "output valid" and so on; stable.
[[nodiscard]] HOLDFAST_API const char* name(RepairRuleKind kind);

struct RepairRule {
  RepairRuleKind kind;
  std::size_t violations = 0;
  std::vector<std::string> first;  ///< the first of them, one sentence each
  std::string detail;              ///< what was examined
  [[nodiscard]] bool holds() const { return violations == 0; }
};

struct RepairCheckResult {
  std::vector<RepairRule> rules;
  [[nodiscard]] bool holds() const {
    for (const RepairRule& rule : rules)
      if (!rule.holds()) return false;
    return true;
  }
};

struct RepairCheckOptions : Limits {
  std::size_t most = 20;  ///< violations of one rule that are described
  ProgressFunction progress = {};
};

/// Checks exactly that `output` and the claims about it keep the promise of `repair` for `input`.
///
/// The check proves, without sampling, that every input facet lies near its children: see
/// src/check_repair/cover.h. Any arrays are accepted, however wrong. Throws Interrupted for its limits, and
/// std::bad_alloc.
[[nodiscard]] HOLDFAST_API RepairCheckResult check_repaired(const Complex& input, const Complex& output,
                                                            const RepairClaims& claims,
                                                            const RepairCheckOptions& options = {});

}  // namespace holdfast
