// Holdfast: an exact check of the promise, independent of the mesher's own state.
#pragma once

#include "holdfast/export.h"
#include "holdfast/limits.h"
#include "holdfast/types.h"

namespace holdfast {

/// The rules of the promise, in the order in which a check lists them. The numbers are stable.
enum class RuleKind : int {
  input_vertices_kept = 1,
  well_formed = 2,
  no_vertex_unused = 3,
  volumes_positive = 4,
  facets_kept = 5,
  segments_kept = 6,
  faces_matched = 7,
  boundary_is_input = 8,
  no_overlap = 9,
  steiner_points_inside = 10,
  regions_numbered = 11,
  markers_kept = 12,
  nothing_dropped = 13,
  // Only for volumes of second order:
  mid_nodes_placed = 14,
  jacobians_positive = 15,
};

/// "facets kept" and so on; stable.
[[nodiscard]] HOLDFAST_API const char* name(RuleKind kind);

/// One rule of the promise and whether it holds.
struct Rule {
  RuleKind kind;
  std::string name;  ///< the name of `kind`
  bool holds;
  std::string detail;  ///< counts if the rule holds; otherwise the first offending entities
};

struct CheckResult {
  std::vector<Rule> rules;
  [[nodiscard]] bool holds() const {
    for (const Rule& rule : rules)
      if (!rule.holds) return false;
    return true;
  }
};

/// What a check accepts.
struct CheckOptions : Limits {
  bool outside_dropped = false;  ///< input facets outside every tetrahedron are accepted
  bool box = false;              ///< the mesh may extend to an enclosing box, as with Keep::box
  ProgressFunction progress = {};
};

/// Checks a volume against the surface that it should keep, exactly.
///
/// Vertices of the surface with identical coordinates count as one vertex. The volume must begin with these
/// distinct vertices, in the order of `vertex_map` (holdfast.h). Findings name the surface's own indices.
/// Vertices of the volume are never merged.
///
/// The result lists all rules in the order of `RuleKind`. Rules on mid-edge nodes appear only if the volume
/// has such nodes. A rule that cannot be decided because another is broken does not hold, and its detail
/// begins with "not examined". Any arrays are accepted, however wrong. Throws Interrupted for its limits, and
/// std::bad_alloc.
[[nodiscard]] HOLDFAST_API CheckResult check(const Complex& surface, const Volume& volume,
                                             const CheckOptions& options = {});

}  // namespace holdfast
