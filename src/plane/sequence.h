// A sequence of numbers in an order defined by its owner.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace holdfast::plane {

/// Each number below a bound may occur once. Numbers are stored in short blocks, in which the place for a new
/// one is found by bisection, and are also linked to each other.
class Sequence {
 public:
  using Number = std::uint32_t;

  explicit Sequence(std::size_t bound)
      : end_(static_cast<Number>(bound)),
        next_(bound + 1, end_),
        previous_(bound + 1, end_),
        block_of_(bound + 1) {}

  /// The position before the first number and after the last one.
  [[nodiscard]] Number end() const { return end_; }
  [[nodiscard]] Number next(Number i) const { return next_[i]; }
  [[nodiscard]] Number previous(Number i) const { return previous_[i]; }

  /// The first number for which `is_before` is false, or end(). Those for which it is true must come first.
  template <typename Before>
  [[nodiscard]] Number find(const Before& is_before) const {
    const auto block = std::partition_point(order_.begin(), order_.end(), [&](std::uint32_t b) {
      return is_before(blocks_[b].numbers[blocks_[b].size - 1]);
    });
    if (block == order_.end()) return end_;
    const Block& found = blocks_[*block];
    return *std::partition_point(found.numbers.begin(), found.numbers.begin() + found.size - 1, is_before);
  }

  /// Inserts `i`, which must not be in it, before `at`.
  void insert(Number at, Number i) {
    next_[i] = at;
    previous_[i] = previous_[at];
    next_[previous_[i]] = previous_[at] = i;
    if (order_.empty()) order_.push_back(add_block());
    std::uint32_t b = at == end_ ? order_.back() : block_of_[at];
    if (blocks_[b].size == kMost) {
      split(b);
      b = at == end_ ? order_.back() : block_of_[at];
    }
    Block& block = blocks_[b];
    const auto last = block.numbers.begin() + block.size;
    const auto place = at == end_ ? last : std::find(block.numbers.begin(), last, at);
    std::copy_backward(place, last, last + 1);
    *place = i;
    ++block.size;
    block_of_[i] = b;
  }

  void erase(Number i) {
    next_[previous_[i]] = next_[i];
    previous_[next_[i]] = previous_[i];
    const std::uint32_t b = block_of_[i];
    Block& block = blocks_[b];
    const auto last = block.numbers.begin() + block.size;
    const auto place = std::find(block.numbers.begin(), last, i);
    std::copy(place + 1, last, place);
    if (--block.size > 0) return;
    order_.erase(std::find(order_.begin(), order_.end(), b));
    free_.push_back(b);
  }

 private:
  static constexpr std::size_t kMost = 32;
  struct Block {
    std::uint32_t size = 0;
    std::array<Number, kMost> numbers;
  };

  [[nodiscard]] std::uint32_t add_block() {
    if (free_.empty()) {
      blocks_.emplace_back();
      return static_cast<std::uint32_t>(blocks_.size() - 1);
    }
    const std::uint32_t b = free_.back();
    free_.pop_back();
    return b;
  }

  /// Moves half of a block's numbers to a new block after it.
  void split(std::uint32_t b) {
    const std::uint32_t other = add_block();
    order_.insert(std::find(order_.begin(), order_.end(), b) + 1, other);
    Block &from = blocks_[b], &to = blocks_[other];
    from.size = to.size = kMost / 2;
    std::copy(from.numbers.begin() + from.size, from.numbers.end(), to.numbers.begin());
    for (std::size_t k = 0; k < to.size; ++k) block_of_[to.numbers[k]] = other;
  }

  Number end_;
  std::vector<Number> next_, previous_;
  std::vector<std::uint32_t> block_of_;  // of each number
  std::vector<Block> blocks_;
  std::vector<std::uint32_t> order_, free_;  // of blocks
};

}  // namespace holdfast::plane
