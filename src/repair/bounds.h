// Upper bounds on distances moved, in doubles rounded up, and the lengths that they depend on.
#pragma once

#include <span>
#include <vector>

#include "arrange/arrange.h"
#include "holdfast/types.h"
#include "mesh/parallel.h"

namespace holdfast::repairing {

/// Sums of numbers that are rounded up.
[[nodiscard]] double sum_above(double a, double b);

/// The distance of each new point from the doubles nearest to it.
[[nodiscard]] std::vector<double> rounded_by(const arrange::Arrangement& arrangement, const Threads& threads);

[[nodiscard]] double largest(const std::vector<double>& distances);

/// The last bit of the largest coordinate.
[[nodiscard]] double last_bit(std::span<const Point> points);

/// The longest side of the vertices' box.
[[nodiscard]] double extent(std::span<const Point> points);

}  // namespace holdfast::repairing
