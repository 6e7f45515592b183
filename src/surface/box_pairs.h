// The pairs of overlapping boxes of two lists.
#pragma once

#include <utility>
#include <vector>

#include "surface/aabb_tree.h"

namespace holdfast {

/// Calls visit(i, j) for each box i of the first list and each box j of the second one that overlap, until it
/// returns false. The order depends on the boxes alone. Calls step(fraction) as AabbTree::for_each_overlap.
template <class Visit, class Step>
void for_each_overlap_between(std::vector<Box> first, const std::vector<Box>& second, const Visit& visit,
                              const Step& step) {
  const auto first_count = static_cast<Index>(first.size());
  first.insert(first.end(), second.begin(), second.end());
  AabbTree(first).for_each_overlap(
      [&](Index i, Index j) {
        if (i > j) std::swap(i, j);
        return i >= first_count || j < first_count || visit(i, j - first_count);
      },
      [](Index, Index) { return false; }, step);
}

}  // namespace holdfast
