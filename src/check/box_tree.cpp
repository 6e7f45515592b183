// Check: a tree of axis-parallel boxes, split at the median of the centres along the longest axis.
#include "check/box_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace holdfast::checking {

Box box_of(std::span<const Index> corners, std::span<const Point> vertices) {
  Box box(vertices[corners[0]]);
  for (const Index corner : corners.subspan(1)) box.extend(vertices[corner]);
  return box;
}

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), items_(boxes_.size()) {
  std::iota(items_.begin(), items_.end(), 0U);
  nodes_.reserve(boxes_.size());
  if (!boxes_.empty()) build(0, static_cast<std::uint32_t>(boxes_.size()));
}

void BoxTree::build(std::uint32_t first, std::uint32_t last) {
  Box box = boxes_[items_[first]];
  for (std::uint32_t i = first + 1; i < last; ++i) box.extend(boxes_[items_[i]]);
  const std::size_t at = nodes_.size();
  nodes_.push_back({box, 0, first, last});
  if (last - first <= leaf_size) {
    std::sort(items_.begin() + first, items_.begin() + last);
    return;
  }

  // Halves first: sums and differences of huge coordinates would overflow.
  const auto extent = [&](std::size_t axis) { return box.high[axis] / 2 - box.low[axis] / 2; };
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (extent(i) > extent(axis)) axis = i;
  const auto centre = [&](std::uint32_t item) {
    return boxes_[item].low[axis] / 2 + boxes_[item].high[axis] / 2;
  };
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(
      items_.begin() + first, items_.begin() + middle, items_.begin() + last,
      [&](std::uint32_t x, std::uint32_t y) { return std::pair(centre(x), x) < std::pair(centre(y), y); });
  build(first, middle);
  nodes_[at].right = static_cast<std::uint32_t>(nodes_.size());
  build(middle, last);
}

}  // namespace holdfast::checking
