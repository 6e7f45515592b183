// Vertices that lie near to each other, or to a side or facet, joined within the user's tolerance.
#pragma once

#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

/// `RepairOptions::weld`. Returns the largest distance by which anything moved or was bent, rounded up: less
/// than the tolerance, with room left for rounding where that is possible.
double weld(State& state, double tolerance, const Step& step);

}  // namespace holdfast::repairing
