// Points of which those in a triangle are asked for, and which are taken out one by one.
//
// clang-format off
//        [ all ]          Boxes over points along a Hilbert curve, eight by eight, and over eight boxes, and
//       /   |    \        so on (Kamel, Faloutsos 1993, On packing R-trees). A box that no point is left in,
//    [  ] [  ] [  ]       or that lies outside one side of the triangle, is passed by.
//    .... .... ....
// clang-format on
//
// Eight boxes are compared with that of the triangle at once, by the cells of a grid that their corners lie
// in; those that are left, by their corners.
#pragma once

#include <algorithm>
#include <bit>
#include <span>
#include <vector>

#include "plane/grid.h"
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
    if (order_.empty()) return;
    const Query query(*this, a, b, c);
    walk(query, levels_.size(), 0, visit);
  }

 private:
  static constexpr std::size_t kFan = 8;
  using Lanes = std::int16_t __attribute__((vector_size(2 * kFan)));

  struct Box {
    Position low, high;
  };
  struct Node {
    Box box;
    std::uint32_t left;  // items in it
  };
  /// Cells of eight boxes, or of eight points, which have their high corners at the low ones.
  struct Group {
    std::array<Lanes, 2> low, high;

    /// Cells are not negative, so that nothing is near a box that ends below them.
    void clear(std::size_t lane) {
      for (std::size_t k = 0; k < 2; ++k) low[k][lane] = high[k][lane] = -1;
    }
    [[nodiscard]] bool stands(std::size_t lane) const { return low[0][lane] >= 0; }
    void set(std::size_t lane, const std::array<std::int16_t, 2>& from,
             const std::array<std::int16_t, 2>& to) {
      for (std::size_t k = 0; k < 2; ++k) {
        low[k][lane] = from[k];
        high[k][lane] = to[k];
      }
    }
  };

  class Query {
   public:
    Query(const PointTree& tree, Vertex a, Vertex b, Vertex c);
    /// Which boxes of a group may meet that of the triangle: a byte each, the first one lowest, 1 for yes.
    [[nodiscard]] std::uint64_t near(const Group& group) const {
      using Bytes = std::int8_t __attribute__((vector_size(kFan)));
      const Lanes apart = (group.low[0] > high_[0]) | (low_[0] > group.high[0]) | (group.low[1] > high_[1]) |
                          (low_[1] > group.high[1]);
      const std::uint64_t near =
          ~std::bit_cast<std::uint64_t>(__builtin_convertvector(apart, Bytes)) & 0x0101010101010101u;
      return std::endian::native == std::endian::little ? near : __builtin_bswap64(near);
    }
    /// False only where no point of the box lies in the triangle.
    [[nodiscard]] bool may_meet(const Box& box) const {
      if (box.low[0] > box_.high[0] || box.high[0] < box_.low[0] || box.low[1] > box_.high[1] ||
          box.high[1] < box_.low[1])
        return false;
      // Of an ear, the side ca is the one within the polygon.
      return !(certain_ && (is_right_of(2, box) || is_right_of(0, box) || is_right_of(1, box)));
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
    std::array<Lanes, 2> low_, high_;
    bool certain_;  // corners are where their doubles are
  };

  /// The cell of a place, or of the one nearest to it that the grid has.
  [[nodiscard]] std::array<std::int16_t, 2> cell(const Position& p) const {
    return {static_cast<std::int16_t>(grid_.cell(p[0], 0)), static_cast<std::int16_t>(grid_.cell(p[1], 1))};
  }
  template <typename BoxOf>
  void add_groups(std::size_t count, BoxOf&& box_of);
  void add_level();

  // Of a group at a level, 0 for points.
  template <typename Visit>
  bool walk(const Query& query, std::size_t level, std::size_t group, Visit& visit) const {
    for (std::uint64_t near = query.near(groups_[level][group]); near != 0; near &= near - 1) {
      const std::size_t i = group * kFan + static_cast<std::size_t>(std::countr_zero(near)) / 8;
      if (level > 0) {
        if (query.may_meet(levels_[level - 1][i].box) && !walk(query, level - 1, i, visit)) return false;
      } else if (query.holds(at_[i]) && !visit(order_[i])) {
        return false;
      }
    }
    return true;
  }

  const Points& points_;
  Grid grid_;
  std::vector<std::uint32_t> order_;        // items along the curve
  std::vector<std::uint32_t> place_;        // of an item in this order
  std::vector<Position> at_;                // in this order
  std::vector<std::vector<Node>> levels_;   // from below
  std::vector<std::vector<Group>> groups_;  // of points, then of these
};

}  // namespace holdfast::plane
