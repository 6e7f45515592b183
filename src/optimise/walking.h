// The worst element may go from another mesh round it: random exchanges that make nothing as bad lead there.
#pragma once

#include "optimise/search.h"

namespace holdfast {

/// Takes the worst that is left away, as long as that succeeds. What a walk comes to is taken back where it
/// does not pay.
void walk_from_the_worst(Search& search);

}  // namespace holdfast
