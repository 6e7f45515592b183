// The order in which points are inserted.
#include "plane/order.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

#include "plane/grid.h"

namespace holdfast::plane {
namespace {

constexpr int kBits = 20;  // of a cell's number along an axis

/// Place along the Hilbert curve of a cell (Skilling 2004, Programming the Hilbert curve).
std::uint64_t hilbert(std::uint32_t x, std::uint32_t y) {
  std::uint64_t place = 0;
  for (std::uint32_t s = 1u << (kBits - 1); s > 0; s >>= 1) {
    const std::uint32_t rx = (x & s) != 0, ry = (y & s) != 0;
    place = place << 2 | ((3 * rx) ^ ry);
    if (ry == 0) {
      if (rx == 1) {
        x = ~x;
        y = ~y;
      }
      std::swap(x, y);
    }
  }
  return place;
}

/// A number of an index that looks random (Vigna, splitmix64).
std::uint64_t scattered(std::uint64_t i) {
  i += 0x9E3779B97F4A7C15u;
  i = (i ^ i >> 30) * 0xBF58476D1CE4E5B9u;
  i = (i ^ i >> 27) * 0x94D049BB133111EBu;
  return i ^ i >> 31;
}

}  // namespace

std::vector<Vertex> insertion_order(std::span<const Position> points) {
  if (points.empty()) return {};
  constexpr std::uint64_t kFirstRound = 1024;
  const Grid grid(points, 1u << kBits);
  const int rounds = static_cast<int>(std::bit_width(points.size() / kFirstRound));
  std::vector<std::pair<std::uint64_t, Vertex>> keys(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    // Half of the points come in the last round, a quarter in the one before, and so on.
    const int back = std::min(std::countr_zero(scattered(i)), rounds);
    const std::uint64_t place = hilbert(grid.cell(points[i][0], 0), grid.cell(points[i][1], 1));
    keys[i] = {static_cast<std::uint64_t>(rounds - back) << (2 * kBits) | place, static_cast<Vertex>(i)};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<Vertex> order(points.size());
  for (std::size_t i = 0; i < keys.size(); ++i) order[i] = keys[i].second;
  return order;
}

}  // namespace holdfast::plane
