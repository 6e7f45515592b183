// Check: a tree of axis-parallel boxes. The bounds are doubles of the input, without rounding, so boxes that
// a query skips are disjoint in exact arithmetic too.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "holdfast/types.h"

namespace holdfast::checking {

struct Box {
  Point low, high;

  explicit Box(const Point& point) : low(point), high(point) {}
  void extend(const Point& point) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], point[axis]);
      high[axis] = std::max(high[axis], point[axis]);
    }
  }
  void extend(const Box& box) {
    extend(box.low);
    extend(box.high);
  }
  [[nodiscard]] bool meets(const Box& box) const {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (low[axis] > box.high[axis] || box.low[axis] > high[axis]) return false;
    return true;
  }
  /// Whether the ray from `origin` towards +x meets the box.
  [[nodiscard]] bool meets_ray(const Point& origin) const {
    return high[0] >= origin[0] && low[1] <= origin[1] && origin[1] <= high[1] && low[2] <= origin[2] &&
           origin[2] <= high[2];
  }
};

/// Box of the corners of a facet, segment or point.
[[nodiscard]] Box box_of(std::span<const Index> corners, std::span<const Point> vertices);

class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::vector<Box> boxes);

  /// Calls `visit(item)` for each box for which `hits(box)` holds. `hits` must hold for a box if it holds for
  /// a part of the box.
  template <class Hits, class Visit>
  void query(Hits&& hits, Visit&& visit) const {
    if (nodes_.empty()) return;
    std::vector<std::uint32_t> open{0};
    while (!open.empty()) {
      const std::uint32_t at = open.back();
      const Node& node = nodes_[at];
      open.pop_back();
      if (!hits(node.box)) continue;
      if (node.right == 0) {
        for (std::uint32_t i = node.first; i < node.last; ++i)
          if (hits(boxes_[items_[i]])) visit(items_[i]);
      } else {
        open.push_back(node.right);
        open.push_back(at + 1);
      }
    }
  }

  /// Calls `visit(item, item)` once for each pair of different boxes that meet.
  template <class Visit>
  void self_pairs(Visit&& visit) const {
    pairs(*this, visit);
  }

  /// The same for each pair of a box of this tree and a box of the other tree that meet.
  template <class Visit>
  void pairs_with(const BoxTree& other, Visit&& visit) const {
    pairs(other, visit);
  }

 private:
  /// A node's left child follows it.
  struct Node {
    Box box;
    std::uint32_t right;        ///< right child, or 0 for a leaf
    std::uint32_t first, last;  ///< range of items below
  };
  static constexpr std::uint32_t leaf_size = 4;

  void build(std::uint32_t first, std::uint32_t last);

  template <class Visit>
  void pairs(const BoxTree& other, Visit&& visit) const {
    if (nodes_.empty() || other.nodes_.empty()) return;
    const bool is_same = &other == this;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> open{{0, 0}};
    while (!open.empty()) {
      const auto [x, y] = open.back();
      open.pop_back();
      const Node &of_x = nodes_[x], &of_y = other.nodes_[y];
      const bool is_one = is_same && x == y;
      if (!is_one && !of_x.box.meets(of_y.box)) continue;
      const bool leaf_x = of_x.right == 0, leaf_y = of_y.right == 0;
      if (leaf_x && leaf_y) {
        pairs_of_leaves(of_x, other, of_y, is_one, visit);
      } else if (is_one) {
        open.emplace_back(x + 1, x + 1);
        open.emplace_back(of_x.right, of_x.right);
        open.emplace_back(x + 1, of_x.right);
      } else if (leaf_y || (!leaf_x && of_x.last - of_x.first >= of_y.last - of_y.first)) {
        open.emplace_back(x + 1, y);
        open.emplace_back(of_x.right, y);
      } else {
        open.emplace_back(x, y + 1);
        open.emplace_back(x, of_y.right);
      }
    }
  }

  template <class Visit>
  void pairs_of_leaves(const Node& x, const BoxTree& other, const Node& y, bool is_one, Visit&& visit) const {
    for (std::uint32_t i = x.first; i < x.last; ++i)
      for (std::uint32_t j = is_one ? i + 1 : y.first; j < y.last; ++j)
        if (boxes_[items_[i]].meets(other.boxes_[other.items_[j]])) visit(items_[i], other.items_[j]);
  }

  std::vector<Box> boxes_;
  std::vector<std::uint32_t> items_;
  std::vector<Node> nodes_;
};

}  // namespace holdfast::checking
