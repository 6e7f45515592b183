// Numbers by keys of a few indices.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "holdfast/types.h"

namespace holdfast::arrange {

/// A hash table with open addressing and linear probing, half full at most; empty ones hold no memory.
template <std::size_t N>
class IndexTable {
 public:
  using Key = std::array<Index, N>;

  /// The number of a key, or `no_entity`.
  [[nodiscard]] Index find(const Key& key) const {
    return slots_.empty() ? no_entity : slots_[place_of(key)].number;
  }
  /// The number of a key; if it has none, it gets `fresh`, which is not `no_entity`.
  Index find_or_add(const Key& key, Index fresh) {
    if (2 * count_ >= slots_.size()) grow();
    Slot& slot = slots_[place_of(key)];
    if (slot.number == no_entity) {
      slot = {key, fresh};
      ++count_;
    }
    return slot.number;
  }

 private:
  struct Slot {
    Key key{};
    Index number = no_entity;
  };

  /// That of the key, or the free one where it belongs.
  [[nodiscard]] std::size_t place_of(const Key& key) const {
    std::uint64_t hash = 0;
    for (const Index k : key) {  // rounds of splitmix64's finaliser (Steele, Lea, Flood 2014)
      hash = (hash ^ k) * 0xBF58476D1CE4E5B9u;
      hash ^= hash >> 31;
    }
    std::size_t i = static_cast<std::size_t>(hash) & (slots_.size() - 1);
    while (slots_[i].number != no_entity && slots_[i].key != key) i = (i + 1) & (slots_.size() - 1);
    return i;
  }

  void grow() {
    constexpr std::size_t kLeast = 32;
    const std::vector<Slot> before =
        std::exchange(slots_, std::vector<Slot>(slots_.empty() ? kLeast : 2 * slots_.size()));
    for (const Slot& slot : before)
      if (slot.number != no_entity) slots_[place_of(slot.key)] = slot;
  }

  std::vector<Slot> slots_;  // a power of two of them
  std::size_t count_ = 0;
};

}  // namespace holdfast::arrange
