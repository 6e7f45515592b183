// Upper bounds on distances moved, in doubles rounded up, and the lengths that they depend on.
#pragma once

#include <span>
#include <vector>

#include "holdfast/types.h"

namespace holdfast::repairing {

/// Sums of numbers that are rounded up.
[[nodiscard]] double sum_above(double a, double b);

[[nodiscard]] double largest(const std::vector<double>& distances);

/// The last bit of the largest coordinate.
[[nodiscard]] double last_bit(std::span<const Point> points);

/// The longest side of the vertices' box.
[[nodiscard]] double extent(std::span<const Point> points);

}  // namespace holdfast::repairing
