// Divide and conquer: an order that begins in the middle.
#pragma once

#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

namespace holdfast::numbers {

/// The order: the middle element, then the middle of each half, then of each quarter, and so on.
template <typename T>
[[nodiscard]] std::vector<T> halved(const std::vector<T>& elements) {
  std::vector<T> order;
  order.reserve(elements.size());
  std::deque<std::pair<std::size_t, std::size_t>> ranges{{0, elements.size()}};
  for (; !ranges.empty(); ranges.pop_front()) {
    const auto [first, last] = ranges.front();
    if (first == last) continue;
    const std::size_t middle = first + (last - first) / 2;
    order.push_back(elements[middle]);
    ranges.emplace_back(first, middle);
    ranges.emplace_back(middle + 1, last);
  }
  return order;
}

}  // namespace holdfast::numbers
