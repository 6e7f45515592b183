// Orders of points.
#pragma once

#include <span>
#include <vector>

#include "plane/given_points.h"

namespace holdfast::plane {

/// Indices of points in a biased randomised insertion order (Amenta, Choi, Rote 2003): rounds that double,
/// each along a Hilbert curve. Consecutive points are close together. The expected size of the triangulation
/// is quadratic on the way only if it is quadratic in the end.
[[nodiscard]] std::vector<Vertex> insertion_order(std::span<const Position> points);

/// Indices of points along a Hilbert curve; a few points close together keep their given order.
[[nodiscard]] std::vector<Vertex> curve_order(std::span<const Position> points);

/// Indices of points in lexicographic order; points at one place keep their given order.
[[nodiscard]] std::vector<Vertex> order_from_left(const GivenPoints& points);

}  // namespace holdfast::plane
