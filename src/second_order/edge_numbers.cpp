#include "second_order/edge_numbers.h"

#include <stdexcept>

namespace holdfast {

Index EdgeNumbers::of(Index a, Index b, std::size_t first) {
  const Segment edge = sorted(a, b);
  std::size_t slot = slot_of(edge);
  if (slots_[slot] != no_entity) return slots_[slot];
  if (first + edges_.size() >= no_entity)
    throw std::length_error("holdfast: more nodes than can be counted in 32 bits");
  if (2 * edges_.size() >= slots_.size()) {
    grow();
    slot = slot_of(edge);
  }
  slots_[slot] = static_cast<Index>(edges_.size());
  edges_.push_back(edge);
  return slots_[slot];
}

// The slot of the edge, or the one where it would be inserted.
std::size_t EdgeNumbers::slot_of(const Segment& edge) const {
  // Fibonacci hashing (Knuth, The Art of Computer Programming 3, section 6.4): the high bits are the best
  // mixed.
  constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15;
  std::uint64_t hash = (std::uint64_t{edge[0]} << 32 | edge[1]) * kGolden;
  hash ^= hash >> 32;
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = static_cast<std::size_t>(hash * kGolden >> 20) & mask;
  while (slots_[slot] != no_entity && edges_[slots_[slot]] != edge) slot = (slot + 1) & mask;
  return slot;
}

void EdgeNumbers::grow() {
  slots_.assign(2 * slots_.size(), no_entity);
  for (std::size_t i = 0; i < edges_.size(); ++i) slots_[slot_of(edges_[i])] = static_cast<Index>(i);
}

}  // namespace holdfast
