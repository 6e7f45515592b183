// Polygons of more than three corners, which some formats carry.
#include "io/polygon.h"

namespace holdfast::io {

std::vector<Index> without_repeats(std::span<const Point> vertices, std::span<const Index> corners) {
  std::vector<Index> distinct;
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (vertices[corners[i]] != vertices[corners[(i + corners.size() - 1) % corners.size()]])
      distinct.push_back(corners[i]);
  return distinct;
}

}  // namespace holdfast::io
