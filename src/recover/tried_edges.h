// The edges that flips tried in vain since the mesh last changed, so that a deep search tries none twice.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/keys.h"
#include "mesh/tet_mesh.h"
#include "numbers/mix.h"

namespace holdfast {

/// A set of edges with the most levels of flips that each was tried with. Forgetting takes no time.
class TriedEdges {
 public:
  void forget() {
    ++generation_;
    count_ = 0;
  }

  /// Notes a trial. Returns false if a trial with as many levels is noted already.
  bool add(Vertex a, Vertex b, int depth) {
    if (2 * count_ >= slots_.size()) grow();
    const EdgeKey key = edge_key(a, b);
    Slot& slot = slots_[place_of(key)];
    if (slot.generation != generation_) {
      slot = {key, generation_, depth};
      ++count_;
      return true;
    }
    if (slot.depth >= depth) return false;
    slot.depth = depth;
    return true;
  }

 private:
  struct Slot {
    EdgeKey key;
    std::uint64_t generation = 0;
    int depth = 0;
  };

  // That of the key, or the free one where it belongs (linear probing).
  [[nodiscard]] std::size_t place_of(EdgeKey key) const {
    std::size_t i = static_cast<std::size_t>(key * numbers::kGolden >> 32) & (slots_.size() - 1);
    while (slots_[i].generation == generation_ && slots_[i].key != key) i = (i + 1) & (slots_.size() - 1);
    return i;
  }

  void grow() {
    std::vector<Slot> before(std::max<std::size_t>(64, 2 * slots_.size()));
    before.swap(slots_);
    for (const Slot& slot : before)
      if (slot.generation == generation_) slots_[place_of(slot.key)] = slot;
  }

  std::vector<Slot> slots_;  // a power of two of them
  std::uint64_t generation_ = 1;
  std::size_t count_ = 0;
};

}  // namespace holdfast
