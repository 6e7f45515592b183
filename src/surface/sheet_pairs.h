// Surface layer: pairs of facets of different sheets that may meet.
//
// A sheet holds facets that lie in a plane but for rounding, as an arrangement makes them. Two sheets meet in
// a line, and of both only what touches the other's plane can meet at all; that is few, and along the line it
// is found by a sweep. A tree of boxes of all facets would compare many more: the boxes of what is cut by
// many planes mix.
//
// A means of search only. Let h(x) = n x - d, in floating point, be almost 0 on a sheet, and |x| the largest
// coordinate of a point. Since coordinates are rounded in relation to their size, |h| <= t |y| at the corners
// y of a facet for some small t; and if one coordinate of all three is at least |y| / 4 and has one sign,
// then |h| <= 4 t |y| on all of the facet: a convex combination of the corners is at least as large in that
// coordinate as that of the |y| / 4. A facet of another sheet with h > 4 t |x| at its corners has this
// everywhere, by the triangle inequality, and is disjoint from it. So what lies near the origin is told
// apart as finely as its doubles are. Facets without such a coordinate, round the origin, are a part of the
// sheet by themselves, for which |h| <= t.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "holdfast/types.h"
#include "mesh/parallel.h"
#include "surface/aabb_tree.h"
#include "surface/elements.h"

namespace holdfast {

class SheetPairs {
 public:
  /// `sheet`: for each element the number of its sheet, or `no_index`. `known`: for each whether it fits
  /// together with all others of which that is said; empty where nothing is known.
  SheetPairs(const Complex& complex, const Elements& elements, std::span<const Index> sheet,
             std::span<const std::uint8_t> known, const Threads& threads);

  /// Whether boxes of sheets overlap more often than there are elements, as those of needles side by side do.
  /// Then nothing is prepared.
  [[nodiscard]] bool are_too_many() const { return too_many_; }
  /// Pairs of parts, of different sheets, whose boxes overlap; but for those that are wholly known.
  [[nodiscard]] const std::vector<std::array<Index, 2>>& all() const { return pairs_; }

  /// Visits facets of two parts, as indices of Elements::all, that have overlapping boxes and touch each
  /// other's planes, until that returns false. Other pairs of facets of the two are disjoint.
  using Visit = std::function<bool(Index i, Index j)>;
  bool for_each(const std::array<Index, 2>& parts, const Visit& visit) const;

 private:
  struct Part {
    Index sheet = 0;
    bool is_round_origin = false, is_known = false;
    std::vector<Index> facets;
    Box box{};
    AabbTree tree;                              // of the facets' boxes
    std::vector<std::array<Point, 3>> corners;  // of its items, side by side in memory
    Point normal{};
    double offset = 0;
    double most = 0, most_share = 0;  // |h(x)| <= most + most_share |x| on all facets
  };
  using Items = std::vector<AabbTree::Item>;  // with indices of Elements::all

  void divide(std::span<const Index> sheet, std::span<const std::uint8_t> known);
  [[nodiscard]] bool is_round_origin(const Triangle& facet) const;
  void list_pairs(std::size_t most);
  void measure(Part& part) const;
  [[nodiscard]] Items touching(const Part& part, const Part& plane) const;

  const Complex& complex_;
  const Elements& elements_;
  std::vector<Part> parts_;
  std::vector<std::array<Index, 2>> pairs_;
  bool too_many_ = false;
};

}  // namespace holdfast
