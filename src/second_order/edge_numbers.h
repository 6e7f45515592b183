// Numbers edges in the order in which they first appear.
#pragma once

#include <cstdint>
#include <vector>

#include "holdfast/types.h"

namespace holdfast {

/// A hash table with open addressing, at most half full so that searches are short.
class EdgeNumbers {
 public:
  explicit EdgeNumbers(std::size_t expected = 0) {
    while (slots_.size() < 2 * expected) slots_.resize(2 * slots_.size(), no_entity);
  }

  /// The number of an edge, in either direction; a new edge gets the next number. Throws std::length_error if
  /// numbers from `first` on would exceed 32 bits.
  Index of(Index a, Index b, std::size_t first = 0);
  /// The number of an edge, or `no_entity`.
  [[nodiscard]] Index find(Index a, Index b) const { return slots_[slot_of(sorted(a, b))]; }
  /// The edges by number, the lower end first.
  [[nodiscard]] const std::vector<Segment>& edges() const { return edges_; }

 private:
  static Segment sorted(Index a, Index b) { return a < b ? Segment{a, b} : Segment{b, a}; }
  [[nodiscard]] std::size_t slot_of(const Segment& edge) const;
  void grow();

  std::vector<Segment> edges_;
  std::vector<Index> slots_ = std::vector<Index>(64, no_entity);  // their count is a power of two
};

}  // namespace holdfast
