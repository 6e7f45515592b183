// Free slots of parts of a mesh that threads change at the same time: each part has its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "mesh/anatomy.h"

namespace holdfast {

class SlotPools {
 public:
  using Pool = std::uint8_t;
  static constexpr Pool kNoPool = 0xFF;

  SlotPools(std::size_t slots, std::size_t pools) : pool_of_(slots, kNoPool), free_(pools) {}

  /// Of a slot, free or not; kNoPool for one that no part may change.
  [[nodiscard]] Pool pool_of(Tet t) const { return pool_of_[t]; }
  void assign(Tet t, Pool pool) { pool_of_[t] = pool; }
  [[nodiscard]] std::size_t spare(std::size_t pool) const { return free_[pool].slots.size(); }
  /// From the pool of another slot. Whoever changes a part sees to it that there is one.
  [[nodiscard]] Tet take(Tet near) {
    std::vector<Tet>& free = free_[pool_of_[near]].slots;
    if (free.empty()) throw std::logic_error("holdfast: a part of a mesh has no free slot left");
    const Tet t = free.back();
    free.pop_back();
    return t;
  }
  void give(Tet t) { free_[pool_of_[t]].slots.push_back(t); }

  /// All that are free, pool by pool.
  [[nodiscard]] std::vector<Tet> all() const {
    std::vector<Tet> all;
    for (const Free& free : free_) all.insert(all.end(), free.slots.begin(), free.slots.end());
    return all;
  }

 private:
  struct alignas(64) Free {  // threads must not share cache lines
    std::vector<Tet> slots;
  };

  std::vector<Pool> pool_of_;  // by slot
  std::vector<Free> free_;     // by pool
};

}  // namespace holdfast
