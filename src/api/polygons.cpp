// The public function of holdfast/polygons.h.
#include "holdfast/polygons.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "numbers/float_environment.h"
#include "plane/facets.h"

namespace holdfast {
namespace {

void require_polygons(std::span<const Point> vertices, std::span<const Index> corners,
                      std::span<const std::size_t> offsets) {
  if (offsets.empty() ? !corners.empty() : offsets.front() != 0 || offsets.back() != corners.size())
    throw std::invalid_argument("offsets of polygons must begin with 0 and end with the number of corners");
  for (std::size_t i = 0; i + 1 < offsets.size(); ++i)
    if (offsets[i + 1] < offsets[i] || offsets[i + 1] - offsets[i] < 3)
      throw std::invalid_argument("polygon " + std::to_string(i) + " has fewer than three corners");
  const auto wrong =
      std::find_if(corners.begin(), corners.end(), [&](Index corner) { return corner >= vertices.size(); });
  if (wrong != corners.end())
    throw std::invalid_argument("a polygon names vertex " + std::to_string(*wrong) + ", but there are " +
                                std::to_string(vertices.size()));
}

}  // namespace

CutPolygons cut_polygons(std::span<const Point> vertices, std::span<const Index> corners,
                         std::span<const std::size_t> offsets) {
  require_polygons(vertices, corners, offsets);
  const FloatEnvironment environment;
  CutPolygons all;
  for (std::size_t i = 0; i + 1 < offsets.size(); ++i) {
    const plane::CutPolygon cut =
        plane::cut_polygon(vertices, corners.subspan(offsets[i], offsets[i + 1] - offsets[i]), {});
    all.triangles.insert(all.triangles.end(), cut.triangles.begin(), cut.triangles.end());
    all.polygons.resize(all.triangles.size(), static_cast<Index>(i));
    all.deviation = std::max(all.deviation, cut.deviation);
    all.crossing += cut.crosses ? 1 : 0;
  }
  return all;
}

}  // namespace holdfast
