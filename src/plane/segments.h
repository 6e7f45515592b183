// Where a segment passes through a closed triangulation.
#pragma once

#include <optional>
#include <vector>

#include "plane/triangles.h"

namespace holdfast::plane {

/// The edge ab, seen from its left, or the edges that the segment ab crosses, from a to b, each seen from the
/// side of a; neither, if it passes through a vertex or through a constrained edge. `mesh` has its stars.
struct Passage {
  EdgeCode edge = kNoEdge;
  std::vector<EdgeCode> crossed;
};
[[nodiscard]] std::optional<Passage> passage(const Triangles& mesh, const Points& points, Vertex a, Vertex b);

}  // namespace holdfast::plane
