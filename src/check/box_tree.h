// Check: a tree of axis-parallel boxes. Boxes have doubles of the input as bounds, nothing is rounded,
// so whatever a query skips is disjoint in exact arithmetic too.
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

  /// Calls `visit(item)` for each box that `hits(box)`; `hits` must hold for a box if for a part of it.
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
    if (nodes_.empty()) return;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> open{{0, 0}};
    while (!open.empty()) {
      const auto [x, y] = open.back();
      open.pop_back();
      if (x != y && !nodes_[x].box.meets(nodes_[y].box)) continue;
      const bool leaf_x = nodes_[x].right == 0;
      const bool leaf_y = nodes_[y].right == 0;
      if (leaf_x && leaf_y) {
        pairs_of_leaves(x, y, visit);
      } else if (x == y) {
        open.emplace_back(x + 1, x + 1);
        open.emplace_back(nodes_[x].right, nodes_[x].right);
        open.emplace_back(x + 1, nodes_[x].right);
      } else if (leaf_y ||
                 (!leaf_x && nodes_[x].last - nodes_[x].first >= nodes_[y].last - nodes_[y].first)) {
        open.emplace_back(x + 1, y);
        open.emplace_back(nodes_[x].right, y);
      } else {
        open.emplace_back(x, y + 1);
        open.emplace_back(x, nodes_[y].right);
      }
    }
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
  void pairs_of_leaves(std::uint32_t x, std::uint32_t y, Visit&& visit) const {
    for (std::uint32_t i = nodes_[x].first; i < nodes_[x].last; ++i)
      for (std::uint32_t j = x == y ? i + 1 : nodes_[y].first; j < nodes_[y].last; ++j)
        if (boxes_[items_[i]].meets(boxes_[items_[j]])) visit(items_[i], items_[j]);
  }

  std::vector<Box> boxes_;
  std::vector<std::uint32_t> items_;
  std::vector<Node> nodes_;
};

}  // namespace holdfast::checking
