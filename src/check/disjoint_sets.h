// Check: disjoint sets of indices, joined in pairs (path halving, Tarjan and van Leeuwen 1984).
#pragma once

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "holdfast/types.h"

namespace holdfast::checking {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size), size_(size, 1) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  /// The representative of the set that holds x.
  [[nodiscard]] Index find(Index x) {
    while (parent_[x] != x) {
      parent_[x] = parent_[parent_[x]];
      x = parent_[x];
    }
    return x;
  }
  void join(Index x, Index y) {
    x = find(x);
    y = find(y);
    if (x == y) return;
    if (size_[x] < size_[y]) std::swap(x, y);
    parent_[y] = x;
    size_[x] += size_[y];
  }
  /// The members of every set, in order, ordered by their first members.
  [[nodiscard]] std::vector<std::vector<Index>> members() {
    std::vector<std::vector<Index>> sets;
    std::vector<std::size_t> of_root(parent_.size(), parent_.size());
    for (Index x = 0; x < parent_.size(); ++x) {
      std::size_t& set = of_root[find(x)];
      if (set == parent_.size()) {
        set = sets.size();
        sets.emplace_back();
      }
      sets[set].push_back(x);
    }
    return sets;
  }

 private:
  std::vector<Index> parent_;
  std::vector<Index> size_;
};

}  // namespace holdfast::checking
