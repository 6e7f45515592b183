#include "delaunay/order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "mesh/large_array.h"
#include "mesh/parallel.h"
#include "numbers/mix.h"

namespace holdfast {
namespace {

struct Entry {
  std::uint64_t key;
  std::uint32_t point;
};

constexpr unsigned kMostBits = 20;    // of the curve, an axis; leaves four bits of the key for the round
constexpr unsigned kMostRounds = 15;  // fits those four bits
constexpr unsigned kRoundShift = 3;   // a round holds 2^3 times the points of all rounds before it
constexpr std::size_t kFirstRound = 256;
// Points in one cell of the grid that are worth another sort. Fewer may be duplicates at their distance.
constexpr std::size_t kLongRun = kDuplicateDistance;
constexpr std::size_t kLeastPart = 8192;  // entries that are worth a thread

// Bits an axis that roughly separate n points on a surface. Runs that still share a cell are sorted again in
// a grid of their own.
unsigned bits_for(std::size_t n) {
  return std::clamp((static_cast<unsigned>(std::bit_width(n)) + 1) / 2 + 1, 4u, kMostBits);
}

// The cube round a set of points, as a map to integers. Halving keeps extents finite near the end of the
// exponent range. It is exact above the denormals, whose last bit does not matter here.
class Grid {
 public:
  Grid(std::span<const Point> points, std::span<const Entry> entries, unsigned bits) : bits_(bits) {
    low_ = points[entries.front().point];
    Point high = low_;
    for (const Entry& e : entries) {
      const Point& p = points[e.point];
      for (std::size_t i = 0; i < 3; ++i) {
        low_[i] = std::min(low_[i], p[i]);
        high[i] = std::max(high[i], p[i]);
      }
    }
    double extent = 0;
    for (std::size_t i = 0; i < 3; ++i) extent = std::max(extent, high[i] - low_[i]);
    flat_ = !(extent > 0);
    if (!std::isfinite(extent)) {
      shrink_ = 0.5;
      extent = 0;
      for (std::size_t i = 0; i < 3; ++i) extent = std::max(extent, 0.5 * high[i] - 0.5 * low_[i]);
    }
    extent_ = extent;
    cells_ = std::ldexp(1.0, static_cast<int>(bits));
  }

  // Whether all points are equal.
  [[nodiscard]] bool flat() const { return flat_; }

  [[nodiscard]] std::uint64_t key(const Point& p) const {
    std::array<std::uint32_t, 3> x{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double t = (shrink_ * p[i] - shrink_ * low_[i]) / extent_ * cells_;
      x[i] = static_cast<std::uint32_t>(std::min(t, cells_ - 1));
    }
    return hilbert(x);
  }

 private:
  // Skilling's transform of coordinates into the transposed Hilbert index, then the interleaving.
  [[nodiscard]] std::uint64_t hilbert(std::array<std::uint32_t, 3> x) const {
    for (unsigned b = bits_ - 1; b > 0; --b) {
      const std::uint32_t p = (1u << b) - 1;
      for (std::uint32_t& xi : x) {
        const std::uint32_t low_set = (0u - ((xi >> b) & 1u)) & p;
        const std::uint32_t swap = (x[0] ^ xi) & (p & ~low_set);
        x[0] ^= low_set | swap;
        xi ^= swap;
      }
    }
    x[1] ^= x[0];
    x[2] ^= x[1];
    std::uint32_t t = 0;
    for (unsigned b = bits_ - 1; b > 0; --b) t ^= (0u - ((x[2] >> b) & 1u)) & ((1u << b) - 1);
    for (std::uint32_t& xi : x) xi ^= t;
    return spread(x[0]) << 2 | spread(x[1]) << 1 | spread(x[2]);
  }

  // Puts bit i at bit 3 i.
  static std::uint64_t spread(std::uint64_t x) {
    x = (x | x << 32) & 0x1F00000000FFFFull;
    x = (x | x << 16) & 0x1F0000FF0000FFull;
    x = (x | x << 8) & 0x100F00F00F00F00Full;
    x = (x | x << 4) & 0x10C30C30C30C30C3ull;
    x = (x | x << 2) & 0x1249249249249249ull;
    return x;
  }

  unsigned bits_;
  Point low_{};
  double shrink_ = 1;
  double extent_ = 0;
  double cells_ = 0;
  bool flat_ = false;
};

// Stable sort by the low `bits` bits of the keys, least significant digit first. Each part of the entries
// counts its digits and knows from the counts of all where its entries go, so that the result does not
// depend on the number of parts.
void radix_sort(std::span<Entry> entries, unsigned bits, const Threads& threads) {
  constexpr unsigned kMostDigit = 12;
  constexpr std::size_t kSmall = 512;
  if (entries.size() < kSmall) {
    std::stable_sort(entries.begin(), entries.end(),
                     [](const Entry& a, const Entry& b) { return a.key < b.key; });
    return;
  }
  const unsigned passes = (bits + kMostDigit - 1) / kMostDigit;
  const unsigned width = (bits + passes - 1) / passes;
  const std::size_t parts = std::clamp<std::size_t>(entries.size() / kLeastPart, 1, threads.count());
  std::vector<std::array<std::size_t, std::size_t{1} << kMostDigit>> counts(parts);
  LargeArray<Entry> other(entries.size());
  Entry* from = entries.data();
  Entry* to = other.data();
  const auto part = [&](std::size_t k) {
    const std::size_t first = entries.size() * k / parts;
    return std::span<const Entry>(from + first, entries.size() * (k + 1) / parts - first);
  };
  for (unsigned shift = 0; shift < bits; shift += width) {
    const auto digit = [=](const Entry& e) { return (e.key >> shift) & ((1u << width) - 1); };
    parallel(threads, parts, [&](std::size_t k) {
      counts[k].fill(0);
      for (const Entry& e : part(k)) ++counts[k][digit(e)];
    });
    std::size_t sum = 0;
    for (std::size_t d = 0; d < std::size_t{1} << width; ++d)
      for (auto& count : counts) count[d] = std::exchange(sum, sum + count[d]);
    parallel(threads, parts, [&](std::size_t k) {
      for (const Entry& e : part(k)) to[counts[k][digit(e)]++] = e;
    });
    std::swap(from, to);
  }
  if (from != entries.data()) std::copy(from, from + entries.size(), entries.data());
}

// Sorts entries whose keys hold their round above the curve's bits. Then it sorts each run of points that
// share a cell again, in a grid of their own extent. That keeps clusters of any scale local. Every run is a
// proper subset, because the extreme points of an extent lie in different cells.
void sort_along_curve(std::span<const Point> points, std::span<Entry> entries, unsigned round_bits,
                      const Threads& threads) {
  const unsigned bits = bits_for(entries.size());
  const Grid grid(points, entries, bits);
  if (grid.flat() && round_bits == 0) return;
  parallel_ranges(threads, entries.size(), [&](std::size_t first, std::size_t last) {
    for (Entry& e : entries.subspan(first, last - first))
      e.key = (e.key << (3 * bits)) | (grid.flat() ? 0u : grid.key(points[e.point]));
  });
  radix_sort(entries, 3 * bits + round_bits, threads);
  for (std::size_t first = 0; first < entries.size();) {
    std::size_t last = first + 1;
    while (last < entries.size() && entries[last].key == entries[first].key) ++last;
    if (last - first > kLongRun) {
      const std::span<Entry> run = entries.subspan(first, last - first);
      for (Entry& e : run) e.key = 0;
      sort_along_curve(points, run, 0, 1);
    }
    first = last;
  }
}

}  // namespace

InsertionOrder insertion_order(std::span<const Point> points, std::uint64_t seed, const Threads& threads) {
  const std::size_t n = points.size();
  if (n == 0) return {};
  unsigned rounds = 0;
  for (std::size_t m = n; m > kFirstRound && rounds < kMostRounds; m >>= kRoundShift) ++rounds;
  LargeArray<Entry> array(n);
  const std::span<Entry> entries(array.data(), n);
  const std::uint64_t salt = numbers::mixed(seed);
  const auto round_of = [&](std::size_t point) {
    const auto zeros = static_cast<unsigned>(std::countr_zero(numbers::mixed(point ^ salt)));
    return rounds - std::min(zeros / kRoundShift, rounds);
  };
  parallel_ranges(threads, n, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) entries[i] = {round_of(i), static_cast<std::uint32_t>(i)};
  });
  InsertionOrder order;
  order.ends.assign(rounds + 1, 0);
  for (const Entry& e : entries) ++order.ends[e.key];
  std::partial_sum(order.ends.begin(), order.ends.end(), order.ends.begin());
  sort_along_curve(points, entries, static_cast<unsigned>(std::bit_width(rounds)), threads);
  order.points.resize(n);
  for (std::size_t i = 0; i < n; ++i) order.points[i] = entries[i].point;
  return order;
}

}  // namespace holdfast
