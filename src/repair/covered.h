// The distance of a surface from its original facets where these lost parts.
#pragma once

#include <optional>

#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

/// While a single closed line goes round the parts of a facet, through its corners and beside its sides, the
/// displacements of the line and the parts bound the distance of the facet from its parts. If parts became
/// lines or points, the facet may be further away. So this tries `most` and some multiples of it, in
/// ascending order. It returns the first distance within which the parts of all input facets (`given`) cover
/// these facets, as `check --repaired` decides, or nothing if no multiple suffices.
[[nodiscard]] std::optional<double> covered_within(const State& state, const State& given, double most,
                                                   const Step& step);

/// The same, and if no such multiple suffices, a distance within which they do. A tip that is lost may be far
/// longer than it was thick.
[[nodiscard]] double cover_distance(const State& state, const State& given, double most, const Step& step);

}  // namespace holdfast::repairing
