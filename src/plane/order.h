// Orders of points.
#pragma once

#include <span>
#include <vector>

#include "plane/given_points.h"

namespace holdfast::plane {

/// Indices of points in a biased randomised insertion order (Amenta, Choi, Rote 2003): rounds that double,
/// each along a Hilbert curve. Points that follow each other lie near each other, and no input makes the
/// Delaunay triangulation quadratic in expectation that is not so in the end.
[[nodiscard]] std::vector<Vertex> insertion_order(std::span<const Position> points);

/// Indices of points along a Hilbert curve; of a few that lie close together, in the order given.
[[nodiscard]] std::vector<Vertex> curve_order(std::span<const Position> points);

/// Indices of points in lexicographic order, and of those at one place in the order given.
[[nodiscard]] std::vector<Vertex> order_from_left(const GivenPoints& points);

}  // namespace holdfast::plane
