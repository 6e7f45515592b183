// Surface layer: points with identical coordinates are one place. +0 and -0 are equal; numbers that are not
// finite are equal if their bits are.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "holdfast/types.h"

namespace holdfast {

/// Finds the entry at a place. The points stay with the caller.
///
/// An open hash table with linear probing. It also keeps half of each hash, so that a look-up seldom touches
/// the wrong point.
class PlaceTable {
 public:
  /// `expected`: the number of distinct places, if known.
  explicit PlaceTable(std::size_t expected) {
    slots_.resize(std::bit_ceil(std::max<std::size_t>(2 * expected, 64)));
  }

  /// The hash of a point that is looked up soon. Prefetches its slot.
  [[nodiscard]] std::uint64_t announce(const Point& point) const {
    const std::uint64_t hash = hash_of(point);
    __builtin_prefetch(&slots_[hash & (slots_.size() - 1)]);
    return hash;
  }

  /// The entry at the place of `point`, which has this hash; if there is none, enters `fresh` for it.
  /// `point_of(entry)` is the point of an entry.
  template <class PointOf>
  Index find_or_add(const Point& point, std::uint64_t hash, Index fresh, const PointOf& point_of) {
    const auto tag = static_cast<std::uint32_t>(hash >> 32);
    std::size_t i = hash & (slots_.size() - 1);
    for (; slots_[i].entry != kNone; i = (i + 1) & (slots_.size() - 1))
      if (slots_[i].tag == tag && same(point_of(slots_[i].entry), point)) return slots_[i].entry;
    slots_[i] = {fresh, tag};
    if (2 * ++count_ > slots_.size()) grow(point_of);
    return fresh;
  }

  /// The entry at the place of `point`, or `no_entity`.
  template <class PointOf>
  [[nodiscard]] Index find(const Point& point, const PointOf& point_of) const {
    const std::uint64_t hash = hash_of(point);
    const auto tag = static_cast<std::uint32_t>(hash >> 32);
    for (std::size_t i = hash & (slots_.size() - 1); slots_[i].entry != kNone;
         i = (i + 1) & (slots_.size() - 1))
      if (slots_[i].tag == tag && same(point_of(slots_[i].entry), point)) return slots_[i].entry;
    return no_entity;
  }

  [[nodiscard]] static std::uint64_t hash_of(const Point& point) {
    std::uint64_t hash = 0;
    for (const double x : point) {
      // Rounds of splitmix64's finaliser (Steele, Lea, Flood 2014) without the last shift.
      hash = (hash ^ bits(x)) * 0xBF58476D1CE4E5B9u;
      hash = (hash ^ (hash >> 29)) * 0x94D049BB133111EBu;
      hash ^= hash >> 32;
    }
    return hash;
  }

 private:
  static constexpr Index kNone = 0xFFFFFFFF;
  struct Slot {
    Index entry = kNone;
    std::uint32_t tag = 0;
  };

  /// The bits to compare; -0 has those of +0.
  static std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x); }
  static bool same(const Point& a, const Point& b) {
    return bits(a[0]) == bits(b[0]) && bits(a[1]) == bits(b[1]) && bits(a[2]) == bits(b[2]);
  }

  template <class PointOf>
  void grow(const PointOf& point_of) {
    const std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(2 * slots_.size()));
    for (const Slot& slot : old) {
      if (slot.entry == kNone) continue;
      std::size_t i = hash_of(point_of(slot.entry)) & (slots_.size() - 1);
      while (slots_[i].entry != kNone) i = (i + 1) & (slots_.size() - 1);
      slots_[i] = slot;
    }
  }

  std::vector<Slot> slots_;
  std::size_t count_ = 0;
};

/// Gives points at one place the same index: for formats that repeat vertices in every triangle. The first
/// point at a place keeps its bits.
class Welder {
 public:
  /// `expected`: the number of distinct points, if known.
  explicit Welder(std::vector<Point>& points, std::size_t expected = 0) : points_(points), table_(expected) {}

  /// The index of `point`, which is appended if it is new.
  Index add(const Point& point) { return add(point, PlaceTable::hash_of(point)); }

  /// The index of the point at the place of `point`, or `no_entity`.
  [[nodiscard]] Index find(const Point& point) const {
    return table_.find(point, [&](Index i) { return points_[i]; });
  }

  [[nodiscard]] std::uint64_t announce(const Point& point) const { return table_.announce(point); }

  /// As add(point), for a point with this hash.
  Index add(const Point& point, std::uint64_t hash) {
    const auto fresh = static_cast<Index>(points_.size());
    const Index index =
        table_.find_or_add(point, hash, fresh, [&](Index i) { return i == fresh ? point : points_[i]; });
    if (index == fresh) points_.push_back(point);
    return index;
  }

 private:
  std::vector<Point>& points_;
  PlaceTable table_;
};

}  // namespace holdfast
