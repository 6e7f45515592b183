// Check of repairs: whether edges that are odd in a sum modulo 2 fall into closed chains, one for each side
// of a triangle.
#pragma once

#include <span>

#include "holdfast/types.h"

namespace holdfast::checking {

struct SidedEdge {
  Segment ends;
  unsigned sides = 0;   ///< the sides whose chains may contain it, as bits
  bool is_odd = false;  ///< in the sum of all chains
};

/// Whether there are three chains without boundary, each of edges that it may contain, whose sum is the odd
/// edges. Each edge must be given once. An edge that is not odd may be in two of the chains.
[[nodiscard]] bool are_closed_chains(std::span<const SidedEdge> edges);

}  // namespace holdfast::checking
