// Walks to another mesh round the worst element, from which it may be removable, by random exchanges that
// make no element as bad.
#pragma once

#include "optimise/search.h"

namespace holdfast {

/// Removes the worst element left, as long as that succeeds. A walk that does not pay is undone.
void walk_from_the_worst(Search& search);

}  // namespace holdfast
