// The size that elements should have at a point, before there is a mesh: an estimate of the sizes that field
// points will get from the surface (docs/sizes.md).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "holdfast/types.h"

namespace holdfast::division {

/// The least of h(v) + gradation * |p - v| over all vertices v, where h(v) is the mean length of the edges of
/// facets and segments at v, or up to a ninth more; at most what `limit` says.
class WantedSize {
 public:
  /// Indices must be in range. `limit` may give 0 for none; so may be empty.
  WantedSize(const Complex& complex, double gradation, std::function<double(const Point&)> limit);

  [[nodiscard]] double operator()(const Point& p) const;

 private:
  struct Source {
    Point where;
    double size;
  };
  /// A box of some sources, in a binary tree.
  struct Box {
    Point low, high;
    double least;  ///< size of its sources
    std::size_t begin, end;
    std::size_t second = 0;  ///< the second of its halves; the first follows it; 0 for a leaf
  };
  std::size_t build(std::size_t begin, std::size_t end);
  [[nodiscard]] double bound(const Box& box, const Point& p) const;

  double gradation_;
  std::function<double(const Point&)> limit_;
  std::vector<Source> sources_;
  std::vector<Box> boxes_;
};

}  // namespace holdfast::division
