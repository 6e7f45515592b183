// How many points at least a sheet gets where its traces cross, without making them.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "plane/points.h"

namespace holdfast::arrange {

/// The ends of a straight piece, rounded to nearest.
using Piece = std::array<plane::Position, 2>;

/// A number of points that are certainly different, in each of which two pieces certainly cross between their
/// ends, and that are none of the given `points`, which are rounded, too. The search ends when `enough` are
/// found, or when it takes long for so many.
[[nodiscard]] std::size_t count_crossings(std::span<const Piece> pieces,
                                          std::span<const plane::Position> points, std::size_t enough);

}  // namespace holdfast::arrange
