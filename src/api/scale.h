// Powers of two that bring a complex near the ends of the exponent range to where floating-point guesses
// work. The predicates answer rightly anywhere; this is for speed and for good guesses.
#pragma once

#include <span>
#include <vector>

#include "exact/double_grid.h"
#include "exact/point.h"
#include "holdfast/types.h"

namespace holdfast {

/// k such that the vertices times 2^k are worked on: 0 unless magnitudes are extreme; else the largest
/// coordinate comes as near to one as it can while every coordinate stays exact.
[[nodiscard]] int choose_scale(std::span<const Point> vertices);

/// The coordinates, of what is worked on, that are doubles once k is undone.
[[nodiscard]] exact::DoubleGrid grid_after(int k);

/// p times 2^k in doubles; exact for k = choose_scale(...) and one of its vertices.
[[nodiscard]] Point scaled(const Point& p, int k);
[[nodiscard]] std::vector<Point> scaled(std::span<const Point> points, int k);

/// p times 2^k, exactly.
[[nodiscard]] exact::ExactPoint scaled(const exact::ExactPoint& p, int k);

}  // namespace holdfast
