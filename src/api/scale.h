// Powers of two that move a complex from the ends of the exponent range to where floating-point guesses work.
// Predicates are right at any scale; this is for speed and for good guesses.
#pragma once

#include <span>
#include <vector>

#include "exact/double_grid.h"
#include "exact/point.h"
#include "holdfast/types.h"

namespace holdfast {

/// Returns k such that the mesher works on the vertices times 2^k: 0 unless magnitudes are extreme; otherwise
/// the largest coordinate comes as near to one as is possible with every coordinate exact.
[[nodiscard]] int choose_scale(std::span<const Point> vertices);

/// The coordinates of scaled points that are doubles after k is undone.
[[nodiscard]] exact::DoubleGrid grid_after(int k);

/// p times 2^k in doubles; exact for k = choose_scale(...) and vertices of that complex.
[[nodiscard]] Point scaled(const Point& p, int k);
[[nodiscard]] std::vector<Point> scaled(std::span<const Point> points, int k);

/// p times 2^k, exactly.
[[nodiscard]] exact::ExactPoint scaled(const exact::ExactPoint& p, int k);

}  // namespace holdfast
