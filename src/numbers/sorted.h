// Lists in ascending order, each entry once.
#pragma once

#include <algorithm>

namespace holdfast {

/// Sorts a list and takes out what is in it more than once.
template <typename List>
void sort_unique(List& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace holdfast
