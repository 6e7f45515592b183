// Makes segments edges by swaps (paper §2.2), and triangles constrained Delaunay by swaps (Lawson 1977).
#pragma once

#include "numbers/random.h"
#include "plane/segments.h"

namespace holdfast::plane {

/// Swaps edges crossed by a segment, at random, until it crosses none.
class SegmentSwaps {
 public:
  SegmentSwaps(Triangles& mesh, const Points& points) : mesh_(mesh), points_(points) {}

  /// Swaps for the segment ab with the passage `crossed`. Adds swapped edges to `swapped`, seen from both
  /// sides. Returns the number of swaps; stops at `most`.
  std::size_t lay(Vertex a, Vertex b, const std::vector<EdgeCode>& crossed, numbers::Random& random,
                  std::vector<EdgeCode>& swapped, std::size_t most = SIZE_MAX);

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  struct Link {
    EdgeCode edge;  // seen from the side of a
    std::uint32_t before, after, place;
  };
  [[nodiscard]] int side(Vertex v) const { return v == a_ || v == b_ ? 0 : points_.orient(a_, b_, v); }
  [[nodiscard]] bool crosses(Vertex p, Vertex q) const { return side(p) * side(q) < 0; }
  [[nodiscard]] EdgeCode near_side(EdgeCode diagonal, std::uint32_t before) const;
  EdgeCode swap(std::size_t k);
  void remove(std::uint32_t link);

  Triangles& mesh_;
  const Points& points_;
  Vertex a_ = kNoVertex, b_ = kNoVertex;
  std::vector<Link> links_;              // in order from a
  std::vector<std::uint32_t> standing_;  // those still crossed, in any order
};

/// Swaps unconstrained edges until no triangle's circumcircle contains the opposite corner of a neighbour,
/// except across constraints. Starts with the edges of the triangles of `pending`, which ends empty. Returns
/// the number of swaps.
std::size_t swap_to_delaunay(Triangles& mesh, const Points& points, std::vector<EdgeCode>& pending,
                             const Poll& poll);
/// The same for all edges.
std::size_t swap_to_delaunay(Triangles& mesh, const Points& points, const Poll& poll);

}  // namespace holdfast::plane
