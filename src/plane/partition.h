// Makes segments edges by points where they cross the mesh, and removes these points again (paper §2.3).
#pragma once

#include "plane/segments.h"

namespace holdfast::plane {

/// A segment in pieces: its two ends and between them, in order, the points added on it.
using Pieces = std::vector<Vertex>;

class Partition {
 public:
  /// `mesh` must be closed and have its stars (find_stars).
  Partition(Triangles& mesh, Points& points) : mesh_(mesh), points_(points) {}

  /// Adds points where the segment ab crosses the edges of its passage `crossed`. The pieces are then
  /// constraints.
  [[nodiscard]] Pieces insert(Vertex a, Vertex b, const std::vector<EdgeCode>& crossed);

  /// Removes the points on a segment by swaps, which makes it an edge. Removed points stay in `points`.
  /// Returns the number of swaps.
  std::size_t remove(const Pieces& pieces);

 private:
  void split(EdgeCode e, Vertex p);
  [[nodiscard]] std::uint32_t unused_triangle();
  [[nodiscard]] std::vector<Vertex> vertices_above(const Pieces& pieces) const;
  Vertex disconnect_above(const Pieces& pieces);
  void disconnect_to_the_left(Vertex s, Vertex before, Vertex behind);
  void disconnect_to_the_right(Vertex s, Vertex before, Vertex behind);
  [[nodiscard]] std::vector<EdgeCode> edges_of(const Pieces& pieces) const;
  std::uint32_t close(const std::vector<EdgeCode>& pieces);

  Triangles& mesh_;
  Points& points_;
  std::vector<std::uint32_t> unused_;  // triangles
  std::size_t swaps_ = 0;
};

}  // namespace holdfast::plane
