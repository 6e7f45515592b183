// Disjoint sets of indices that are joined in pairs and taken apart again in reverse order (Westbrook and
// Tarjan 1989). Members of a set can be listed.
#pragma once

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "holdfast/types.h"

namespace holdfast {

class UndoableSets {
 public:
  explicit UndoableSets(std::size_t n) : parent_(n), next_(n), size_(n, 1) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
    std::iota(next_.begin(), next_.end(), Index{0});
  }

  /// A member of the set that holds v, the same for all of its members. Takes logarithmic time, because the
  /// smaller of two sets joins the larger one.
  [[nodiscard]] Index root(Index v) const {
    while (parent_[v] != v) v = parent_[v];
    return v;
  }

  void unite(Index a, Index b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    if (size_[a] < size_[b]) std::swap(a, b);
    parent_[b] = a;
    size_[a] += size_[b];
    std::swap(next_[a], next_[b]);  // two cycles of members become one
    joined_.push_back(b);
  }

  /// Calls f(w) for each member w of the set that holds v.
  template <class F>
  void for_each_member(Index v, F&& f) const {
    Index w = v;
    do {
      f(w);
      w = next_[w];
    } while (w != v);
  }

  [[nodiscard]] std::size_t mark() const { return joined_.size(); }

  /// Takes back all that was joined since `mark` was returned.
  void undo_to(std::size_t mark) {
    while (joined_.size() > mark) {
      const Index b = joined_.back(), a = parent_[b];
      joined_.pop_back();
      std::swap(next_[a], next_[b]);
      size_[a] -= size_[b];
      parent_[b] = b;
    }
  }

 private:
  std::vector<Index> parent_, next_, size_;
  std::vector<Index> joined_;
};

}  // namespace holdfast
