// Cells of a regular grid over points.
#pragma once

#include <algorithm>
#include <span>

#include "plane/points.h"

namespace holdfast::plane {

/// Numbers cells from 0 to n - 1 along each axis. The number of a cell grows with the coordinate, exactly so,
/// whatever the magnitudes: halves, and extents that are no denormals, keep it from over- and underflow.
class Grid {
 public:
  Grid() = default;  ///< of one cell
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
    last_ = n - 1;
  }
  /// Places beyond the points are in the outermost cells.
  [[nodiscard]] std::uint32_t cell(double x, std::size_t axis) const {
    return static_cast<std::uint32_t>(std::min(last_, std::max(0.0, (x / 2 - low_[axis]) * scale_[axis])));
  }

 private:
  std::array<double, 2> low_{}, scale_{};
  double last_ = 0;
};

}  // namespace holdfast::plane
