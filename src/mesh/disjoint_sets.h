// Disjoint sets of indices, joined in pairs (path halving, Tarjan and van Leeuwen 1984).
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "holdfast/types.h"

namespace holdfast {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), Index{0}); }

  /// The lowest member of the set that holds v.
  Index root(Index v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }
  /// The same, which any number of threads may ask for.
  [[nodiscard]] Index root_of(Index v) const {
    while (parent_[v] != v) v = parent_[v];
    return v;
  }
  /// True if two sets became one.
  bool unite(Index a, Index b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace holdfast
