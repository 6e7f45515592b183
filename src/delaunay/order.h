// The order in which points are inserted: random rounds of growing size, each along a Hilbert curve.
//
// Sources: Amenta, Choi, Rote 2003 (biased randomised insertion order: the expected work is that of a
// random order, the locality that of a sorted one); Skilling 2004 (Hilbert index by bit transposition).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "holdfast/types.h"

namespace holdfast {

/// A permutation of 0..points.size()-1, a function of the coordinates and the seed alone.
[[nodiscard]] std::vector<std::uint32_t> insertion_order(std::span<const Point> points, std::uint64_t seed);

}  // namespace holdfast
