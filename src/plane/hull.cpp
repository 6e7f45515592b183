// The convex hull as segments (Andrew 1979).
#include "plane/hull.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace holdfast::plane {

void add_hull(const Points& points, std::vector<Ends>& segments) {
  std::vector<Vertex> order(points.size());
  std::iota(order.begin(), order.end(), Vertex{0});
  std::sort(order.begin(), order.end(), [&](Vertex v, Vertex w) { return points.compare(v, w) < 0; });
  // The lower and the upper chain; points on a side stay.
  const auto chain = [&](int side) {
    std::vector<Vertex> hull;
    for (const Vertex v : order) {
      while (hull.size() > 1 && points.orient(hull.end()[-2], hull.back(), v) == -side) hull.pop_back();
      hull.push_back(v);
    }
    return hull;
  };
  const std::vector<Vertex> below = chain(1), above = chain(-1);
  if (below == above) return;
  std::set<Ends> standing;
  for (const Ends& s : segments) standing.insert({std::min(s[0], s[1]), std::max(s[0], s[1])});
  for (const std::vector<Vertex>* hull : {&below, &above})
    for (std::size_t i = 0; i + 1 < hull->size(); ++i) {
      const Ends side{(*hull)[i], (*hull)[i + 1]};
      if (standing.insert({std::min(side[0], side[1]), std::max(side[0], side[1])}).second)
        segments.push_back(side);
    }
}

}  // namespace holdfast::plane
