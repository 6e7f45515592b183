// Check of repairs: sums modulo 2 of edges, and paths in them.
#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "holdfast/types.h"

namespace holdfast::checking {

inline Segment edge_of(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

/// Adds an edge to a sum modulo 2.
inline void flip(std::set<Segment>& sum, const Segment& edge) {
  if (const auto [at, is_new] = sum.insert(edge); !is_new) sum.erase(at);
}

inline void flip(std::set<Segment>& sum, const Triangle& t) {
  for (std::size_t i = 0; i < 3; ++i) flip(sum, edge_of(t[i], t[(i + 1) % 3]));
}

using Neighbours = std::map<Index, std::vector<Index>>;

template <class Edges>
Neighbours neighbours_of(const Edges& edges) {
  Neighbours of;
  for (const auto& [a, b] : edges) {
    of[a].push_back(b);
    of[b].push_back(a);
  }
  return of;
}

/// The edges of a path from a to b with the fewest edges that are not in `cheap`; empty where there is none.
[[nodiscard]] std::vector<Segment> path(const Neighbours& neighbours, const std::set<Segment>& cheap, Index a,
                                        Index b);

}  // namespace holdfast::checking
