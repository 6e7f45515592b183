// Welds vertices with identical coordinates, for formats that repeat them in every triangle.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "io/mesh_data.h"

namespace holdfast::io {

/// Gives points indices, the same one to points with the same coordinates.
///
/// +0 and -0 are one, and the first that came keeps its bits; numbers that are not finite are one if
/// their bits are. An open hash table with linear probing that also keeps half of each hash, so that
/// a look-up seldom touches a point that it does not want.
class Welder {
 public:
  /// `expected` distinct points, as far as known.
  explicit Welder(std::vector<Point>& points, std::size_t expected = 0) : points_(points) {
    slots_.resize(std::bit_ceil(std::max<std::size_t>(2 * expected, 64)));
  }

  /// The index of `point`, which is appended if it is new.
  Index add(const Point& point) { return add(point, hash_of(point)); }

  /// The hash of a point that is added soon: its place in the table is fetched meanwhile.
  [[nodiscard]] std::uint64_t announce(const Point& point) const {
    const std::uint64_t hash = hash_of(point);
    __builtin_prefetch(&slots_[hash & (slots_.size() - 1)]);
    return hash;
  }

  /// As add(point), for a point with this hash.
  Index add(const Point& point, std::uint64_t hash) {
    const auto tag = static_cast<std::uint32_t>(hash >> 32);
    for (std::size_t i = hash & (slots_.size() - 1);; i = (i + 1) & (slots_.size() - 1)) {
      const Slot& slot = slots_[i];
      if (slot.index == kNone) return insert(i, tag, point);
      if (slot.tag == tag && same(points_[slot.index], point)) return slot.index;
    }
  }

 private:
  static constexpr Index kNone = 0xFFFFFFFF;
  struct Slot {
    Index index = kNone;
    std::uint32_t tag = 0;
  };

  /// The bits that are compared: of +0 for -0.
  static std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x); }
  static bool same(const Point& a, const Point& b) {
    return bits(a[0]) == bits(b[0]) && bits(a[1]) == bits(b[1]) && bits(a[2]) == bits(b[2]);
  }
  static std::uint64_t hash_of(const Point& point) {
    std::uint64_t hash = 0;
    for (const double x : point) {
      // Rounds of splitmix64's finaliser (Steele, Lea, Flood 2014) without the last shift.
      hash = (hash ^ bits(x)) * 0xBF58476D1CE4E5B9u;
      hash = (hash ^ (hash >> 29)) * 0x94D049BB133111EBu;
      hash ^= hash >> 32;
    }
    return hash;
  }

  Index insert(std::size_t i, std::uint32_t tag, const Point& point) {
    const auto index = static_cast<Index>(points_.size());
    slots_[i] = {index, tag};
    points_.push_back(point);
    if (2 * points_.size() > slots_.size()) grow();
    return index;
  }

  void grow() {
    slots_.assign(2 * slots_.size(), Slot{});
    for (std::size_t index = 0; index < points_.size(); ++index) {
      const std::uint64_t hash = hash_of(points_[index]);
      std::size_t i = hash & (slots_.size() - 1);
      while (slots_[i].index != kNone) i = (i + 1) & (slots_.size() - 1);
      slots_[i] = {static_cast<Index>(index), static_cast<std::uint32_t>(hash >> 32)};
    }
  }

  std::vector<Point>& points_;
  std::vector<Slot> slots_;
};

}  // namespace holdfast::io
