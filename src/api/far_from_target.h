// How far an element is from the best that its facets allow before a call makes larger efforts for it.
#pragma once

#include <cstddef>

#include "holdfast/holdfast.h"

namespace holdfast {

/// For few facets these efforts cost almost nothing, so they begin earlier.
inline constexpr std::size_t kFewFacets = 1'000;

/// If the worst element is this many times as bad as the facets require, polyhedra around it are filled
/// again.
inline constexpr double kNearTarget = 3, kFarFromTarget = 10;

/// If it still is, other random orders of the whole mesh may do better. With many facets this takes long and
/// needs a larger gain.
inline constexpr double kVeryFarFromTarget = 1'000;

[[nodiscard]] inline bool has_few_facets(const Complex& complex) {
  return complex.facets.size() <= kFewFacets;
}

[[nodiscard]] inline double targets_for_fillings(const Complex& complex) {
  return has_few_facets(complex) ? kNearTarget : kFarFromTarget;
}

[[nodiscard]] inline double targets_for_other_choices(const Complex& complex) {
  return has_few_facets(complex) ? kNearTarget : kVeryFarFromTarget;
}

}  // namespace holdfast
