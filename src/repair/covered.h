// How far a surface is from the facets that it came from, where these lost parts.
#pragma once

#include <optional>

#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

/// As long as one line goes round the parts of a facet, through its corners and beside its sides, how far
/// that and they were moved tells how far the facet is from them. Where parts became lines or points, it may
/// be further. Returns the least of `most` and some multiples of it within which the parts of all facets of
/// the input (`given`) cover these, as `check --repaired` finds it, or nothing where none of these does.
[[nodiscard]] std::optional<double> covered_within(const State& state, const State& given, double most,
                                                   const Step& step);

}  // namespace holdfast::repairing
