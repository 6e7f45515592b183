// Triangulates polygons by cutting off their corners (paper §2.1).
#pragma once

#include <functional>
#include <vector>

#include "holdfast/plane.h"
#include "plane/faces.h"
#include "plane/triangles.h"

namespace holdfast::plane {

struct EarCounts {
  std::size_t ears = 0;    ///< triangles cut off
  std::size_t joined = 0;  ///< triangles made with the reflex corner nearest to a side
};

/// Triangles of faces of a graph, each face joined within itself.
struct EarMesh {
  explicit EarMesh(std::size_t edges) : sides(2 * edges, kNoEdge) {}
  Triangles mesh;
  std::vector<EdgeCode> sides;  ///< edge i has the code at 2 i on its left, at 2 i + 1 on its right
  EarCounts counts;
};

/// Triangulates the faces for which `wanted` returns true, in a graph with `edges` edges. Their walks may
/// pass vertices and edges twice. Points are sorted from left to right (sorted.h).
[[nodiscard]] EarMesh cut_ears(const Points& points, const Walks& faces, std::size_t edges, PlaneEars choice,
                               const std::function<bool(std::size_t)>& wanted);

/// Joins the faces along the graph's edges. The edges from `first_segment` on become constraints.
[[nodiscard]] Triangles join_faces(EarMesh&& ears, std::size_t first_segment);

}  // namespace holdfast::plane
