// Points of which those in a triangle are asked for, and which are taken out one by one.
//
// clang-format off
//        [ all ]          Boxes over points along a Hilbert curve, eight by eight, and over eight boxes, and
//       /   |    \        so on (Kamel, Faloutsos 1993, On packing R-trees). A box that no point is left in,
//    [  ] [  ] [  ]       or that lies outside one side of the triangle, is passed by.
//    .... .... ....
// clang-format on
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "plane/points.h"

namespace holdfast::plane {

class PointTree {
 public:
  /// `vertices` are numbered from 0, as items.
  PointTree(const Points& points, std::span<const Vertex> vertices);

  void erase(std::uint32_t item);

  /// Calls `visit` for items in the positive triangle abc, on its sides too, and some outside, until it
  /// returns false.
  template <typename Visit>
  void each_near(Vertex a, Vertex b, Vertex c, Visit&& visit) const {
    if (levels_.empty()) return;
    const Query query(points_, a, b, c);
    walk(query, levels_.size() - 1, 0, visit);
  }

 private:
  static constexpr std::size_t kFan = 8;
  struct Box {
    Position low, high;
  };
  struct Node {
    Box box;
    std::uint32_t left;  // items in it
  };
  class Query {
   public:
    Query(const Points& points, Vertex a, Vertex b, Vertex c);
    /// False only where no point of the box lies in the triangle.
    [[nodiscard]] bool may_meet(const Box& box) const {
      // Without branches, which could not be foretold.
      const bool meets = static_cast<bool>(
          static_cast<int>(box.low[0] <= box_.high[0]) & static_cast<int>(box.high[0] >= box_.low[0]) &
          static_cast<int>(box.low[1] <= box_.high[1]) & static_cast<int>(box.high[1] >= box_.low[1]));
      if (!meets) return false;
      return !(certain_ && (is_right_of(0, box) || is_right_of(1, box) || is_right_of(2, box)));
    }
    [[nodiscard]] bool holds(const Position& p) const {
      return p[0] >= box_.low[0] && p[0] <= box_.high[0] && p[1] >= box_.low[1] && p[1] <= box_.high[1];
    }

   private:
    // Whether the corner of the box that is furthest to the left of a side lies to its right.
    [[nodiscard]] bool is_right_of(std::size_t side, const Box& box) const {
      const Position &p = corners_[side], &q = corners_[side < 2 ? side + 1 : 0];
      const double x = q[1] < p[1] ? box.high[0] : box.low[0], y = q[0] > p[0] ? box.high[1] : box.low[1];
      return exact::detail::orient2d_filter(p[0], p[1], q[0], q[1], x, y) < 0;
    }

    std::array<Position, 3> corners_;
    Box box_;
    bool certain_;  // corners are where their doubles are
  };

  template <typename Visit>
  bool walk(const Query& query, std::size_t level, std::size_t first, Visit& visit) const {
    const std::vector<Node>& nodes = levels_[level];
    const std::size_t last = std::min(first + kFan, nodes.size());
    for (std::size_t k = first; k < last; ++k) {
      if (nodes[k].left == 0 || !query.may_meet(nodes[k].box)) continue;
      if (level > 0) {
        if (!walk(query, level - 1, k * kFan, visit)) return false;
        continue;
      }
      const std::size_t end = std::min((k + 1) * kFan, order_.size());
      for (std::size_t i = k * kFan; i < end; ++i)
        if (standing_[i] && query.holds(at_[i]) && !visit(order_[i])) return false;
    }
    return true;
  }

  const Points& points_;
  std::vector<std::uint32_t> order_;  // items along the curve
  std::vector<std::uint32_t> place_;  // of an item in this order
  std::vector<Position> at_;          // in this order
  std::vector<std::uint8_t> standing_;
  std::vector<std::vector<Node>> levels_;  // from below
};

}  // namespace holdfast::plane
