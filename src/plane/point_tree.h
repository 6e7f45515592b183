// A tree of points that finds those in a triangle, and from which points are removed one by one.
//
// clang-format off
//        [ all ]          Boxes over points along a Hilbert curve, eight by eight, and over eight boxes, and
//       /   |    \        so on (Kamel, Faloutsos 1993, On packing R-trees). Empty boxes, and boxes outside
//    [  ] [  ] [  ]       one side of the triangle, are skipped.
//    .... .... ....
// clang-format on
//
// Eight boxes are compared with the triangle's box at once, by the grid cells of their corners. If several
// are left, the sides of the triangle decide which of them to search.
#pragma once

#include <array>
#include <bit>
#include <span>
#include <vector>

#include "plane/grid.h"
#include "plane/points.h"

namespace holdfast::plane {

class PointTree {
 public:
  /// The vertices are items 0, 1, ...
  PointTree(const Points& points, std::span<const Vertex> vertices);

  void erase(std::uint32_t item);

  /// Calls `visit` for the items in the closed positive triangle abc, and some outside it, until it returns
  /// false.
  template <typename Visit>
  void each_near(Vertex a, Vertex b, Vertex c, Visit&& visit) const {
    if (order_.empty()) return;
    Query query(*this, {a, b, c});
    walk(query, boxes_.size(), 0, visit);
  }

 private:
  static constexpr std::size_t kFan = 8;
  static constexpr std::size_t kLow = 0, kHigh = 1;
  using Lanes = std::int16_t __attribute__((vector_size(2 * kFan)));

  /// The corners of a box, and how many points are left in it.
  struct Box {
    std::array<Position, 2> at;
    std::uint32_t left;
  };
  /// The cells of eight boxes, or of eight points, whose low and high corners are equal.
  struct Group {
    std::array<Lanes, 2> low, high;

    /// Cells are never negative, so a box that ends below them is near nothing.
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
    Query(const PointTree& tree, const std::array<Vertex, 3>& corners);
    /// Which boxes of a group may meet the triangle's box: one byte each, the first one lowest, 1 for yes.
    [[nodiscard]] std::uint64_t near(const Group& group) const {
      using Bytes = std::int8_t __attribute__((vector_size(kFan)));
      const Lanes apart = (group.low[0] > high_[0]) | (low_[0] > group.high[0]) | (group.low[1] > high_[1]) |
                          (low_[1] > group.high[1]);
      const std::uint64_t near =
          ~std::bit_cast<std::uint64_t>(__builtin_convertvector(apart, Bytes)) & 0x0101010101010101u;
      return std::endian::native == std::endian::little ? near : __builtin_bswap64(near);
    }
    /// True only where no point of the box lies in the triangle.
    [[nodiscard]] bool is_beyond_side(const Box& box) {
      if (!has_sides_) find_sides();
      bool beyond = false;
      for (const Side& s : sides_) beyond |= s.x * box.at[s.x_end][0] + s.y * box.at[s.y_end][1] < s.bound;
      return beyond;
    }

   private:
    /// A place (X, Y) is to the right if x X + y Y is less than the bound; X and Y are taken at the corner of
    /// a box that is furthest to the left.
    struct Side {
      double x = 0, y = 0, bound = 0;
      std::size_t x_end = kLow, y_end = kLow;
    };
    [[nodiscard]] static Side side(const Position& p, const Position& q);
    void find_sides();

    const PointTree& tree_;
    std::array<Position, 3> corners_;  // measured in cells
    std::array<Lanes, 2> low_, high_;
    bool has_sides_ = false;
    std::array<Side, 3> sides_;
  };

  /// The cell of a place, or the nearest cell.
  [[nodiscard]] std::array<std::int16_t, 2> cell(const Position& place) const {
    return {static_cast<std::int16_t>(grid_.cell_at(place[0])),
            static_cast<std::int16_t>(grid_.cell_at(place[1]))};
  }
  [[nodiscard]] static std::vector<Box> boxes_over(const std::vector<Box>& parts);
  void add_groups(const std::vector<Box>& boxes);

  // Visits a group at a level; level 0 has points.
  template <typename Visit>
  bool walk(Query& query, std::size_t level, std::size_t group, Visit& visit) const {
    std::uint64_t near = query.near(groups_[level][group]);
    const bool several = (near & (near - 1)) != 0;
    for (; near != 0; near &= near - 1) {
      const std::size_t i = group * kFan + static_cast<std::size_t>(std::countr_zero(near)) / 8;
      if (level == 0) {
        if (!visit(order_[i])) return false;
      } else if (!(several && query.is_beyond_side(boxes_[level - 1][i]))) {
        if (!walk(query, level - 1, i, visit)) return false;
      }
    }
    return true;
  }

  const Points& points_;
  Grid grid_;
  std::vector<std::uint32_t> order_;        // items along the curve
  std::vector<std::uint32_t> place_;        // by item, its place in this order
  std::vector<std::vector<Box>> boxes_;     // from the lowest level up, measured in cells
  std::vector<std::vector<Group>> groups_;  // of points, then of boxes
};

}  // namespace holdfast::plane
