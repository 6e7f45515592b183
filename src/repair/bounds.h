// Bounds on how far things were moved, in doubles that are rounded up, and what these depend on.
#pragma once

#include <span>
#include <vector>

#include "arrange/arrange.h"
#include "holdfast/types.h"
#include "mesh/parallel.h"

namespace holdfast::repairing {

/// Sums of numbers that are rounded up.
[[nodiscard]] double sum_above(double a, double b);

/// How far each new point is from the doubles nearest to it.
[[nodiscard]] std::vector<double> rounded_by(const arrange::Arrangement& arrangement, const Threads& threads);

[[nodiscard]] double largest(const std::vector<double>& distances);

/// The last bit of the largest coordinate.
[[nodiscard]] double last_bit(std::span<const Point> points);

/// The longest side of their box.
[[nodiscard]] double extent(std::span<const Point> points);

}  // namespace holdfast::repairing
