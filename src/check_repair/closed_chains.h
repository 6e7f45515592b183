// Check of repairs: whether edges that are odd in a sum modulo 2 fall into closed chains, one for each side
// of a triangle.
#pragma once

#include <span>

#include "holdfast/types.h"

namespace holdfast::checking {

struct SidedEdge {
  Segment ends;
  unsigned sides = 0;   ///< those that it may be a part of the chain of, as bits
  bool is_odd = false;  ///< in the sum of all chains
};

/// Whether there are three chains without boundary, each of edges that may be a part of it, of which the odd
/// edges are the sum. Edges must be told once each. What is not odd may be in two of the chains.
[[nodiscard]] bool are_closed_chains(std::span<const SidedEdge> edges);

}  // namespace holdfast::checking
