// The data that the stages of a run pass on.
#pragma once

#include <vector>

#include "plane/sweep.h"

namespace holdfast::plane {

struct Draft {
  Points points;  ///< those of the input, then those that are added
  std::vector<Ends> segments;
  Triangles mesh;
  std::vector<Vertex> order = {};  ///< of each point of the input its number there, if it is not the same

  /// The number of a point in the input; added points come after these.
  [[nodiscard]] Vertex number(Vertex v) const { return v < order.size() ? order[v] : v; }
};

}  // namespace holdfast::plane
