// Orders of points.
#include "plane/order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>

#include "numbers/mix.h"
#include "plane/grid.h"

namespace holdfast::plane {
namespace {

constexpr unsigned kBits = 20;  // of a cell's number along an axis
constexpr unsigned kStep = 4;   // of these, how many the tables take at once
static_assert(kBits % kStep == 0);

/// Positions along the Hilbert curve of a cell in a square of 2^kStep cells, and the orientation of the curve
/// in the cell, for the four orientations in the square: rotated, mirrored, both, neither (Skilling 2004,
/// Programming the Hilbert curve).
struct HilbertTable {
  struct Entry {
    std::uint8_t place, way;
  };
  std::array<std::array<Entry, 1u << 2 * kStep>, 4> of_way{};

  constexpr HilbertTable() {
    for (std::uint32_t way = 0; way < 4; ++way)
      for (std::uint32_t cell = 0; cell < 1u << 2 * kStep; ++cell) of_way[way][cell] = entry(way, cell);
  }

 private:
  static constexpr Entry entry(std::uint32_t way, std::uint32_t cell) {
    bool turned = (way & 1) != 0, mirrored = (way & 2) != 0;
    std::uint32_t place = 0;
    for (std::uint32_t bit = kStep; bit-- > 0;) {
      std::uint32_t x = cell >> (kStep + bit) & 1, y = cell >> bit & 1;
      if (mirrored) std::swap(x, y);
      if (turned) x ^= 1, y ^= 1;
      place = place << 2 | ((3 * x) ^ y);
      if (y != 0) continue;
      turned ^= x != 0;
      mirrored = !mirrored;
    }
    return {static_cast<std::uint8_t>(place),
            static_cast<std::uint8_t>((turned ? 1 : 0) | (mirrored ? 2 : 0))};
  }
};
constexpr HilbertTable kHilbert;

std::uint64_t hilbert(std::uint32_t x, std::uint32_t y) {
  constexpr std::uint32_t kMask = (1u << kStep) - 1;
  std::uint64_t place = 0;
  std::uint32_t way = 0;
  for (unsigned shift = kBits; shift > 0;) {
    shift -= kStep;
    const auto [part, next] = kHilbert.of_way[way][(x >> shift & kMask) << kStep | (y >> shift & kMask)];
    place = place << 2 * kStep | part;
    way = next;
  }
  return place;
}

struct Entry {
  std::uint64_t key;
  Vertex point;
};

constexpr unsigned kDigit = 11;

/// Stable radix sort by the low `bits` bits of the keys, least significant digit first.
void sort(std::vector<Entry>& entries, unsigned bits) {
  constexpr std::size_t kFew = 2048;
  if (entries.size() < kFew) {
    std::stable_sort(entries.begin(), entries.end(),
                     [](const Entry& a, const Entry& b) { return a.key < b.key; });
    return;
  }
  std::vector<Entry> other(entries.size());
  std::vector<std::size_t> next(std::size_t{1} << kDigit);
  for (unsigned shift = 0; shift < bits; shift += kDigit) {
    const auto digit = [=](const Entry& e) { return e.key >> shift & ((1u << kDigit) - 1); };
    std::fill(next.begin(), next.end(), 0);
    for (const Entry& e : entries) ++next[digit(e)];
    std::size_t sum = 0;
    for (std::size_t& n : next) n = std::exchange(sum, sum + n);
    for (const Entry& e : entries) other[next[digit(e)]++] = e;
    entries.swap(other);
  }
}

constexpr unsigned kCellBits = 2 * kDigit;

/// Numbers below `count`, sorted by the cell that `cell` gives, and by `before` within cells of more than
/// `few` numbers.
template <typename Cell, typename Before>
std::vector<Vertex> order_by_cells(std::size_t count, std::size_t few, const Cell& cell,
                                   const Before& before) {
  std::vector<std::uint64_t> keys(count), other(count);  // cells, with their contents in the low half
  std::array<std::vector<std::uint32_t>, 2> next;
  for (std::vector<std::uint32_t>& n : next) n.assign(std::size_t{1} << kDigit, 0);
  constexpr std::uint64_t kMask = (1u << kDigit) - 1;
  for (Vertex v = 0; v < count; ++v) {
    const std::uint64_t c = cell(v);
    keys[v] = c << 32 | v;
    ++next[0][c & kMask];
    ++next[1][c >> kDigit];
  }
  for (std::size_t digit = 0; digit < 2; ++digit) {
    std::uint32_t sum = 0;
    for (std::uint32_t& n : next[digit]) n = std::exchange(sum, sum + n);
    for (const std::uint64_t key : keys) other[next[digit][key >> (32 + digit * kDigit) & kMask]++] = key;
    keys.swap(other);
  }
  std::vector<Vertex> order(count);
  for (std::size_t i = 0; i < count; ++i) order[i] = static_cast<Vertex>(keys[i]);
  for (std::size_t first = 0, last = 0; first < count; first = last) {
    while (last < count && keys[last] >> 32 == keys[first] >> 32) ++last;
    if (last - first > few)
      std::sort(order.begin() + static_cast<std::ptrdiff_t>(first),
                order.begin() + static_cast<std::ptrdiff_t>(last), before);
  }
  return order;
}

/// Half of the points are in the last round, a quarter in the one before, and so on.
std::vector<Vertex> order_in_rounds(std::span<const Position> points, int rounds) {
  if (points.empty()) return {};
  const Grid grid(points, 1u << kBits);
  std::vector<Entry> entries(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int back = std::min(std::countr_zero(numbers::mixed(i)), rounds);
    const std::uint64_t place = hilbert(grid.cell(points[i][0], 0), grid.cell(points[i][1], 1));
    entries[i] = {static_cast<std::uint64_t>(rounds - back) << (2 * kBits) | place, static_cast<Vertex>(i)};
  }
  sort(entries, 2 * kBits + static_cast<unsigned>(std::bit_width(static_cast<unsigned>(rounds))));
  std::vector<Vertex> order(points.size());
  for (std::size_t i = 0; i < entries.size(); ++i) order[i] = entries[i].point;
  return order;
}

}  // namespace

std::vector<Vertex> insertion_order(std::span<const Position> points) {
  constexpr std::uint64_t kFirstRound = 1024;
  return order_in_rounds(points, static_cast<int>(std::bit_width(points.size() / kFirstRound)));
}

std::vector<Vertex> curve_order(std::span<const Position> points) {
  constexpr std::size_t kFewOnCurve = 8;
  if (points.empty()) return {};
  const Grid grid(points, 1u << kBits);
  const auto place = [&](Vertex v) {
    return hilbert(grid.cell(points[v][0], 0), grid.cell(points[v][1], 1));
  };
  return order_by_cells(
      points.size(), kFewOnCurve, [&](Vertex v) { return place(v) >> (2 * kBits - kCellBits); },
      [&](Vertex v, Vertex w) {
        const std::uint64_t p = place(v), q = place(w);
        return p != q ? p < q : v < w;
      });
}

std::vector<Vertex> order_from_left(const GivenPoints& points) {
  if (points.empty()) return {};
  const Grid grid(points.positions(), 1u << kCellBits);
  const auto cell = [&](Vertex v) { return grid.cell(points[v][0], 0); };
  if (const Points* exact = points.exact())
    return order_by_cells(points.size(), 1, cell, [=](Vertex v, Vertex w) {
      const int sign = exact->compare(v, w);
      return sign != 0 ? sign < 0 : v < w;
    });
  return order_by_cells(points.size(), 1, cell, [&](Vertex v, Vertex w) {
    return points[v] != points[w] ? points[v] < points[w] : v < w;
  });
}

}  // namespace holdfast::plane
