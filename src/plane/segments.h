// The passage of a segment through a closed triangulation.
#pragma once

#include <vector>

#include "plane/triangles.h"

namespace holdfast::plane {

struct Passage {
  EdgeCode edge = kNoEdge;
  std::vector<EdgeCode> crossed;
};
/// The edge ab, seen from its left, or the edges that the segment ab crosses, from a to b, each seen from the
/// side of a. Returns false if it passes through a vertex or a constrained edge. `mesh` must have its stars
/// (find_stars).
[[nodiscard]] bool find_passage(const Triangles& mesh, const Points& points, Vertex a, Vertex b,
                                Passage& found);

}  // namespace holdfast::plane
