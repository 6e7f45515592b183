// The data that the stages of a run pass on.
#pragma once

#include <vector>

#include "plane/sweep.h"

namespace holdfast::plane {

struct Draft {
  Points points;  ///< points of the input, then added points
  std::vector<Ends> segments;
  Triangles mesh;
  std::vector<Vertex> order = {};  ///< by point, its number in the input; empty if all are the same

  /// The number of a point in the input; added points come after these.
  [[nodiscard]] Vertex number(Vertex v) const { return v < order.size() ? order[v] : v; }
};

}  // namespace holdfast::plane
