// Points as they are given to a run.
#include "plane/given_points.h"

namespace holdfast::plane {

Points in_order(const GivenPoints& given, std::span<const Vertex> order) {
  if (given.exact() == nullptr) {
    Positions positions(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) positions[i] = given[order[i]];
    return Points(std::move(positions));
  }
  Points points;
  for (const Vertex v : order) points.add(*given.exact(), v);
  return points;
}

Vertex add(Points& points, const GivenPoints& given, Vertex v) {
  return given.exact() == nullptr ? points.add(given[v]) : points.add(*given.exact(), v);
}

}  // namespace holdfast::plane
