// Facets with the same corners, merged before anything is cut.
#pragma once

#include "repair/state.h"

namespace holdfast::repairing {

/// Leaves only the first of facets whose corners are at the same places, with the parents of all of them and
/// the first vertices at these places. Returns the number of facets that went. An arrangement merges such
/// facets as well, but each pair of copies costs as much as four pairs of other facets until then.
std::size_t merge_repeated(State& state);

}  // namespace holdfast::repairing
