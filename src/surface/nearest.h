// The point of a surface's triangles that is nearest to a point, in doubles: this is a measurement and
// decides nothing.
#pragma once

#include <span>
#include <vector>

#include "holdfast/types.h"
#include "surface/aabb_tree.h"

namespace holdfast {

/// A tree of boxes, split at the median of the triangles' centres. The arrays must outlive it.
class NearestOnSurface {
 public:
  /// All vertices of the triangles must exist and be finite. O(n log n) time.
  NearestOnSurface(std::span<const Point> vertices, std::span<const Triangle> triangles);

  /// Finds the nearest point within `distance`, and sets `distance` to its distance. False if there is none.
  [[nodiscard]] bool find(const Point& p, double& distance, Point& nearest) const;

 private:
  struct Node {
    Box box;
    Index first, count, right;  ///< a leaf has no `right`; its left child is the next node
  };
  static constexpr std::size_t kLeaf = 4;

  void build(Index first, Index count);

  std::span<const Point> vertices_;
  std::span<const Triangle> triangles_;
  std::vector<Index> order_;
  std::vector<Point> centres_;
  std::vector<Node> nodes_;
};

/// The point of a triangle that is nearest to p.
[[nodiscard]] Point nearest_on_triangle(const Point& p, const Point& a, const Point& b, const Point& c);

}  // namespace holdfast
