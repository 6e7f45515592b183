// The parts of a double.
#pragma once

#include <bit>
#include <cstdint>

namespace holdfast::exact {

inline constexpr std::uint64_t kMagnitudeBits = ~std::uint64_t{0} >> 1;
inline constexpr std::uint64_t kHiddenBit = std::uint64_t{1} << 52;

/// The bits of |x|; their order as integers is the order of the doubles.
[[nodiscard]] inline std::uint64_t magnitude_bits(double x) {
  return std::bit_cast<std::uint64_t>(x) & kMagnitudeBits;
}

/// |x| = mantissa * 2^exponent for a finite double.
struct FloatParts {
  std::uint64_t mantissa;  ///< below 2^53
  int exponent;            ///< at least -1074
};

/// Takes a double apart, from its magnitude_bits.
[[nodiscard]] inline FloatParts float_parts(std::uint64_t magnitude) {
  const int field = static_cast<int>(magnitude >> 52);
  const std::uint64_t fraction = magnitude & (kHiddenBit - 1);
  if (field == 0) return {fraction, -1074};
  return {fraction | kHiddenBit, field - 1075};
}

/// 2^k, for -1022 <= k <= 1023.
[[nodiscard]] inline double power_of_two(int k) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52);
}

}  // namespace holdfast::exact
