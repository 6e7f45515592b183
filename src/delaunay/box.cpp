#include "delaunay/box.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace holdfast {

std::array<Point, 8> box_corners(std::span<const Point> vertices, double margin,
                                 const exact::DoubleGrid& grid) {
  Point low{}, high{};
  if (!vertices.empty()) low = high = vertices[0];
  for (const Point& p : vertices)
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  double extent = 0;
  for (std::size_t i = 0; i < 3; ++i) extent = std::max(extent, high[i] - low[i]);
  const double step = margin * (extent > 0 ? extent : 1);
  // A step below the spacing of the grid there would leave vertices on the box.
  constexpr double kMost = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = std::min(std::max(grid.nearest(low[i] - step), -kMost), grid.next(low[i], false));
    high[i] = std::max(std::min(grid.nearest(high[i] + step), kMost), grid.next(high[i], true));
  }
  std::array<Point, 8> corners{};
  for (std::size_t k = 0; k < 8; ++k)
    for (std::size_t i = 0; i < 3; ++i) corners[k][i] = ((k >> i) & 1u) != 0 ? high[i] : low[i];
  return corners;
}

}  // namespace holdfast
