// Holdfast: an exact check of the promise (design §1), independent of the mesher's own state.
#pragma once

#include "holdfast/types.h"

namespace holdfast {

/// One rule of the promise and whether it holds.
struct Rule {
  std::string name;  ///< stable, e.g. "facets kept"
  bool holds;
  std::string detail;  ///< counts where it holds; the first offending entities where it does not
};

struct CheckResult {
  std::vector<Rule> rules;
  [[nodiscard]] bool holds() const {
    for (const Rule& rule : rules)
      if (!rule.holds) return false;
    return true;
  }
};

/// What a check may take as given.
struct CheckOptions {
  bool outside_dropped = false;  ///< input facets outside every tetrahedron are accepted
  bool box = false;              ///< the mesh may extend to an enclosing box (--keep box)
};

/// Checks a volume against the surface that it should keep, exactly.
///
/// Vertices of the surface with identical coordinates are one vertex; the volume should begin with the
/// distinct ones, in the order that `vertex_map` (holdfast.h) tells. Findings name the surface's own indices.
/// Vertices of the volume are never taken together.
///
/// The rules, always all of them and in this order: "input vertices kept", "well formed", "no vertex
/// unused", "volumes positive", "facets kept", "segments kept", "faces matched", "boundary is input",
/// "no overlap", "Steiner points inside regions", "regions numbered", "markers kept", "nothing dropped".
/// A rule that cannot be decided because another is broken does not hold, and its detail begins with
/// "not examined". Any arrays are accepted, however wrong. Throws std::bad_alloc only.
[[nodiscard]] CheckResult check(const Complex& surface, const Volume& volume,
                                const CheckOptions& options = {});

}  // namespace holdfast
