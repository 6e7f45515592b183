// The bounded faces of a connected graph in the plane, each as one closed walk.
#pragma once

#include <vector>

#include "plane/sweep.h"

namespace holdfast::plane {

/// Walks one after another, each with its face on the left. A vertex is listed each time the walk passes it.
struct Walks {
  std::vector<Vertex> vertices;
  /// For each vertex, the edge on which the walk leaves it: 2 i for edge i in its direction, 2 i + 1 against
  /// it.
  std::vector<std::uint32_t> sides;
  std::vector<std::size_t> first;  ///< start of each walk, and the end of the last
  [[nodiscard]] std::size_t count() const { return first.size() - 1; }
};

/// The bounded faces between edges that meet only in common ends. The edges of a face must be connected.
/// Points are sorted from left to right (sorted.h).
[[nodiscard]] Walks find_faces(const Points& points, const std::vector<Ends>& edges);

}  // namespace holdfast::plane
