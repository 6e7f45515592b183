// A set of numbers below a bound, which finds the next one from a given number on.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace holdfast::plane {

/// Bits; above them one bit for each word that is not 0, and so on up to a single word.
class NumberSet {
 public:
  explicit NumberSet(std::size_t bound) {
    do {
      bound = (bound + kBits - 1) / kBits;
      levels_.emplace_back(bound, 0);
    } while (bound > 1);
  }

  void insert(std::size_t i) {
    for (std::vector<std::uint64_t>& words : levels_) {
      words[i / kBits] |= bit(i);
      i /= kBits;
    }
  }
  void erase(std::size_t i) {
    for (std::vector<std::uint64_t>& words : levels_) {
      if ((words[i / kBits] &= ~bit(i)) != 0) return;
      i /= kBits;
    }
  }
  [[nodiscard]] bool contains(std::size_t i) const { return (levels_[0][i / kBits] & bit(i)) != 0; }

  /// The least number in the set that is at least `i`, or `none`.
  static constexpr std::size_t none = ~std::size_t{0};
  [[nodiscard]] std::size_t from(std::size_t i) const {
    for (std::size_t level = 0; level < levels_.size(); ++level) {
      const std::vector<std::uint64_t>& words = levels_[level];
      if (i / kBits >= words.size()) return none;
      if (const std::uint64_t left = words[i / kBits] >> i % kBits; left != 0)
        return down(level, i + static_cast<std::size_t>(std::countr_zero(left)));
      i = i / kBits + 1;
    }
    return none;
  }

 private:
  static constexpr std::size_t kBits = 64;

  [[nodiscard]] static std::uint64_t bit(std::size_t i) { return std::uint64_t{1} << i % kBits; }
  /// Descends to the least number below bit `i` of a level.
  [[nodiscard]] std::size_t down(std::size_t level, std::size_t i) const {
    while (level-- > 0) i = i * kBits + static_cast<std::size_t>(std::countr_zero(levels_[level][i]));
    return i;
  }

  std::vector<std::vector<std::uint64_t>> levels_;
};

}  // namespace holdfast::plane
