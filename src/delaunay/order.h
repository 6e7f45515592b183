// The order in which points are inserted: random rounds of growing size, each along a Hilbert curve.
//
// Sources: Amenta, Choi, Rote 2003 (biased randomised insertion order: the expected work is that of a
// random order, the locality that of a sorted one); Skilling 2004 (Hilbert index by bit transposition).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "holdfast/types.h"
#include "mesh/parallel.h"

namespace holdfast {

struct InsertionOrder {
  std::vector<std::uint32_t> points;  ///< a permutation of 0..n-1
  std::vector<std::size_t> ends;      ///< of the rounds: each place where one ends, the last one is n
};

/// A function of the coordinates and the seed alone. Equal points of one round are at most
/// kDuplicateDistance places from the next of them.
[[nodiscard]] InsertionOrder insertion_order(std::span<const Point> points, std::uint64_t seed,
                                             const Threads& threads = 1);

inline constexpr std::size_t kDuplicateDistance = 16;  ///< a schedule looks back so far for equal points

}  // namespace holdfast
