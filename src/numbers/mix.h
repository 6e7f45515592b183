// Mixing of the bits of integers, for hash tables and for random choices that depend on an index alone.
#pragma once

#include <cstdint>

namespace holdfast::numbers {

/// 2^64 over the golden ratio. The highest bits of its product with a key spread consecutive keys evenly
/// (Fibonacci hashing: Knuth, The Art of Computer Programming 3, 6.4).
inline constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15;

/// A permutation of the integers of 64 bits that looks random (splitmix64: Steele, Lea, Flood 2014; Vigna).
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t x) {
  x += kGolden;
  x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9;
  x = (x ^ x >> 27) * 0x94D049BB133111EB;
  return x ^ x >> 31;
}

}  // namespace holdfast::numbers
