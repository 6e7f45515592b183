// Planes across the axes that cut space into parts with equally much work in each.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "holdfast/types.h"

namespace holdfast {

class Cuts {
 public:
  struct Sample {
    Point at;
    double weight;  ///< the work that is to be expected there
  };
  struct Plane {
    std::size_t axis;
    double at;
  };

  /// 2^levels parts. Of the planes across the three axes that leave half of the work on each side, or at
  /// least a given share, the one is taken that has the least close to it.
  Cuts(std::vector<Sample> samples, int levels, double least_share = 0.5);

  [[nodiscard]] std::size_t part_count() const { return planes_.size() + 1; }
  /// The part that holds a point.
  [[nodiscard]] std::uint32_t part_of(const Point& p) const;
  /// Calls act(plane) for the planes that cut a tetrahedron, until it returns true. Returns whether it did.
  template <typename Act>
  bool any_across(const std::array<Point, 4>& corners, Act&& act, std::size_t node = 0) const {
    if (node >= planes_.size()) return false;
    const Plane& plane = planes_[node];
    int below = 0;
    for (const Point& p : corners) below += p[plane.axis] < plane.at ? 1 : 0;
    if (below > 0 && below < 4 && act(plane)) return true;
    return (below > 0 && any_across(corners, act, 2 * node + 1)) ||
           (below < 4 && any_across(corners, act, 2 * node + 2));
  }

 private:
  void cut(std::span<Sample> samples, std::size_t node, std::span<const double> shares);

  std::vector<Plane> planes_;  // a binary tree: below the k-th one are those at 2 k + 1 and 2 k + 2
};

/// Levels of cuts for this many tetrahedra: one from `worth_cutting` on.
[[nodiscard]] int levels_for(double tets, double worth_cutting);

}  // namespace holdfast
