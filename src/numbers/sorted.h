// Lists in ascending order without duplicates; and short arrays in ascending order.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace holdfast {

/// Sorts a list and removes duplicates.
template <typename List>
void sort_unique(List& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// The corners of some faces in ascending order, each once. For each pattern of the lowest bits, the last
/// corner is remembered: this drops most duplicates before the sort.
[[nodiscard]] inline std::vector<std::uint32_t> corners_of_all(
    std::span<const std::array<std::uint32_t, 3>> faces) {
  constexpr std::size_t kRemembered = 64;
  std::array<std::uint64_t, kRemembered> last{};  // one more than the remembered corner
  std::vector<std::uint32_t> corners;
  corners.reserve(faces.size());
  for (const auto& f : faces)
    for (const std::uint32_t v : f)
      if (std::exchange(last[v % kRemembered], std::uint64_t{v} + 1) != std::uint64_t{v} + 1)
        corners.push_back(v);
  sort_unique(corners);
  return corners;
}

/// Two ends or three corners in ascending order: a key that does not depend on their order.
template <typename T, std::size_t N>
[[nodiscard]] constexpr std::array<T, N> ascending(std::array<T, N> of) {
  for (std::size_t i = 1; i < N; ++i)
    for (std::size_t k = i; k > 0 && of[k] < of[k - 1]; --k) std::swap(of[k], of[k - 1]);
  return of;
}

/// Keeps one copy of each value that occurs an odd number of times, in ascending order: a sum modulo 2.
template <typename T>
void sort_odd(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  std::size_t odd = 0;
  for (std::size_t k = 0, next = 0; k < values.size(); k = next) {
    while (next < values.size() && values[next] == values[k]) ++next;
    if ((next - k) % 2 != 0) values[odd++] = values[k];
  }
  values.resize(odd);
}

}  // namespace holdfast
