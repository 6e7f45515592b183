// Lists in ascending order, each entry once; and short arrays in ascending order.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace holdfast {

/// Sorts a list and takes out what is in it more than once.
template <typename List>
void sort_unique(List& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// Two ends, or three corners, in ascending order: the same for any order in which they come.
template <typename T, std::size_t N>
[[nodiscard]] constexpr std::array<T, N> ascending(std::array<T, N> of) {
  for (std::size_t i = 1; i < N; ++i)
    for (std::size_t k = i; k > 0 && of[k] < of[k - 1]; --k) std::swap(of[k], of[k - 1]);
  return of;
}

}  // namespace holdfast
