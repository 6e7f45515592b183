// Random orders and numbers that are the same everywhere.
//
// The standard defines the output of std::mt19937_64. It does not define which of these numbers std::shuffle
// and the distributions of <random> use, or how.
#pragma once

#include <cstdint>
#include <random>
#include <utility>

namespace holdfast::numbers {

using Random = std::mt19937_64;

/// A number from 0 to n - 1, all equally likely (Lemire 2019, Fast random integer generation in an interval).
[[nodiscard]] inline std::uint64_t below(std::uint64_t n, Random& random) {
  __extension__ using Wide = unsigned __int128;
  Wide product = Wide{random()} * n;
  if (static_cast<std::uint64_t>(product) < n) {
    const std::uint64_t threshold = (0 - n) % n;
    while (static_cast<std::uint64_t>(product) < threshold) product = Wide{random()} * n;
  }
  return static_cast<std::uint64_t>(product >> 64);
}

/// A random order, all equally likely: element k swaps places with one of the first k + 1. One random number
/// serves two elements, because a number below i * j is a pair of numbers below i and below j; so sizes must
/// be below 2^32.
template <typename Iterator>
void shuffle(Iterator first, Iterator last, Random& random) {
  const auto size = static_cast<std::uint64_t>(last - first);
  const auto exchange = [&](std::uint64_t i, std::uint64_t j) {
    using std::swap;
    using Difference = decltype(last - first);
    if (i != j) swap(first[static_cast<Difference>(i)], first[static_cast<Difference>(j)]);
  };
  std::uint64_t k = 1;
  if (size > 1 && size % 2 == 0) {
    exchange(1, below(2, random));
    k = 2;
  }
  for (; k + 1 < size; k += 2) {
    const std::uint64_t both = below((k + 1) * (k + 2), random);
    exchange(k, both / (k + 2));
    exchange(k + 1, both % (k + 2));
  }
}

/// The next state of a small generator, whose highest bits are random enough for walks (linear congruential:
/// Press and others, Numerical Recipes).
[[nodiscard]] constexpr std::uint32_t next_congruential(std::uint32_t state) {
  return state * 1664525u + 1013904223u;
}

/// A nearly normal number of mean 0 and variance 1: the sum of four evenly distributed numbers.
[[nodiscard]] inline double bell(Random& random) {
  std::uint64_t bits = random();
  std::int64_t sum = 0;
  for (int k = 0; k < 4; ++k, bits >>= 16) sum += static_cast<std::int64_t>(bits & 0xFFFF);
  constexpr double kMean = 4 * 32767.5, kDeviation = 37837.22723720648;  // sqrt(4 (2^32 - 1) / 12)
  return (static_cast<double>(sum) - kMean) / kDeviation;
}

}  // namespace holdfast::numbers
