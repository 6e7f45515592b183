// Cells of a regular grid over points.
#pragma once

#include <algorithm>
#include <span>

#include "plane/points.h"

namespace holdfast::plane {

/// Numbers cells from 0 to n - 1 along each axis. A cell's number is an exactly monotonic function of the
/// coordinate at any magnitude: halving and extents that are not denormal avoid overflow and underflow.
class Grid {
 public:
  Grid() = default;  ///< has one cell
  Grid(std::span<const Position> points, std::uint32_t n) {
    for (std::size_t k = 0; k < 2; ++k) {
      double least = points[0][k], most = least;
      for (const Position& p : points) {
        least = std::min(least, p[k]);
        most = std::max(most, p[k]);
      }
      low_[k] = least / 2;
      const double extent = most / 2 - least / 2;
      scale_[k] = extent > 0x1p-900 ? (n - 0.5) / extent : 0;
    }
    // Points with the same coordinate on an axis allow any scale.
    for (std::size_t k = 0; k < 2; ++k)
      if (scale_[k] == 0) scale_[k] = scale_[1 - k];
    last_ = n - 1;
  }
  /// Where a point lies, in cells from the first one; it may lie outside the grid.
  [[nodiscard]] Position place(const Position& p) const { return {place(p[0], 0), place(p[1], 1)}; }
  /// The cell of such a coordinate, or the nearest one.
  [[nodiscard]] std::uint32_t cell_at(double place) const {
    return static_cast<std::uint32_t>(std::min(last_, std::max(0.0, place)));
  }
  [[nodiscard]] std::uint32_t cell(double x, std::size_t axis) const { return cell_at(place(x, axis)); }

 private:
  [[nodiscard]] double place(double x, std::size_t axis) const { return (x / 2 - low_[axis]) * scale_[axis]; }

  std::array<double, 2> low_{}, scale_{};
  double last_ = 0;
};

}  // namespace holdfast::plane
