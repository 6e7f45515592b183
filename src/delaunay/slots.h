// The slots of cells that one inserter may fill: those that it freed, and a block that was never used.
#pragma once

#include <vector>

#include "delaunay/triangulation.h"

namespace holdfast {

/// A slot here belongs to no cell and to no other inserter. A freed slot has the sign bit of `reach` set.
class Slots {
 public:
  explicit Slots(Triangulation& triangulation) : triangulation_(triangulation) {}

  /// Makes sure that `count` can be taken. `kGrow`: by growing the array, which nobody else uses. False if
  /// there is no room.
  template <bool kGrow>
  bool provide(std::size_t count) {
    while (freed_.size() + (end_ - next_) < count) {
      const SlotBlock block = kGrow ? triangulation_.grow_slots(count) : triangulation_.claim_slots(count);
      if (block.first == block.end) return false;
      if (block.first != end_) {
        give_back();
        next_ = block.first;
      }
      end_ = block.end;
    }
    return true;
  }

  /// Takes a provided slot, the last freed first.
  [[nodiscard]] Tet take() {
    if (freed_.empty()) return next_++;
    const Tet slot = freed_.back();
    freed_.pop_back();
    return slot;
  }

  /// Returns the slot of a removed cell; its `reach` has the sign bit set.
  void put(Tet slot) { freed_.push_back(slot); }

  /// Marks the rest of the block as free.
  void give_back() {
    Cell* const cells = triangulation_.cells().data();
    for (; next_ < end_; ++next_) {
      cells[next_].reach = -0.0;
      freed_.push_back(next_);
    }
  }

 private:
  Triangulation& triangulation_;
  std::vector<Tet> freed_;
  Tet next_ = 0, end_ = 0;  // of the block
};

}  // namespace holdfast
