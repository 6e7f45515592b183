// Powers of two that bring a complex near the ends of the exponent range to where floating-point guesses
// work (design §2.6). The predicates answer rightly anywhere; this is for speed and for good guesses.
#pragma once

#include <span>

#include "exact/point.h"
#include "holdfast/types.h"

namespace holdfast {

/// k such that the mesher works on the vertices times 2^k: 0 unless magnitudes are extreme, every scaled
/// coordinate is exact, and added vertices find room on the grid of doubles when it is undone.
[[nodiscard]] int choose_scale(std::span<const Point> vertices);

/// p times 2^k in doubles; exact for k = choose_scale(...) and one of its vertices.
[[nodiscard]] Point scaled(const Point& p, int k);

/// p times 2^k, exactly.
[[nodiscard]] exact::ExactPoint scaled(const exact::ExactPoint& p, int k);

}  // namespace holdfast
