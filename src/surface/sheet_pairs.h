// Surface layer: pairs of facets of different sheets that may meet.
//
// A sheet holds facets that are coplanar up to rounding, as an arrangement makes them. Two sheets meet in a
// line, and only facets that touch the other's plane can meet at all. These are few, and a sweep along the
// line finds their pairs. A tree of boxes of all facets would compare many more, because boxes of parts cut
// by many planes mix.
//
// A means of search only. Let h(x) = n x - d, in floating point, be almost 0 on a sheet, and |x| the largest
// coordinate of a point. Since coordinates are rounded in relation to their size, |h| <= t |y| at the corners
// y of a facet for some small t; and if one coordinate of all three is at least |y| / 4 and has one sign,
// then |h| <= 4 t |y| on all of the facet: a convex combination of the corners is at least as large in that
// coordinate as that of the |y| / 4. A facet of another sheet with h > 4 t |x| at its corners has this
// everywhere, by the triangle inequality, and is disjoint from it. So facets near the origin are separated as
// finely as doubles are there. Facets without such a coordinate, round the origin, are a part of the sheet by
// themselves, for which |h| <= t.
//
// Most remaining pairs are of facets with a vertex v on the common line, each in a fan of its own
// sheet. Let only v, of a facet a, be near to the plane of the other sheet, and h >= m > 0 at its other
// corners, which are at most l from v. Let |h| <= t at the corners of a facet b of the other sheet, which has
// v, too, with the opposite side at least r from it. A common point p is s of the way from v to the far side
// of a, and f of that in b: s (m - t) <= |h(p) - h(v)| <= 2 t f and f r <= |p - v| <= s l. So if
// m > 2 t and m / l > 4 t / r, there is none but v. That is a property of each facet, so one comparison
// decides about two fans. Moreover, the part of a facet like a that is close to the plane is close to v, and
// only that part has to be compared with facets without v.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "holdfast/types.h"
#include "mesh/parallel.h"
#include "surface/aabb_tree.h"
#include "surface/elements.h"
#include "surface/oriented_box.h"
#include "surface/round_triangle.h"

namespace holdfast {

class SheetPairs {
 public:
  /// `sheet`: for each element the number of its sheet, or `no_index`. `known`: for each element, whether it
  /// fits together with all others marked so; empty if nothing is known.
  /// At most about twice `block` facets are prepared at once.
  SheetPairs(const Complex& complex, const Elements& elements, std::span<const Index> sheet,
             std::span<const std::uint8_t> known, std::size_t block = kBlock);

  /// Whether more sheets are near each other than there are elements.
  [[nodiscard]] bool are_too_many() const { return too_many_; }
  /// Pairs of parts of different sheets that boxes and triangles round them do not separate, except for parts
  /// that are wholly known.
  [[nodiscard]] const std::vector<std::array<Index, 2>>& all() const { return pairs_; }

  /// Pairs `first` to `last` - 1 of all, whose parts are of two blocks.
  struct Batch {
    std::size_t first, last;
    std::array<std::size_t, 2> blocks;
  };
  [[nodiscard]] const std::vector<Batch>& batches() const { return batches_; }
  /// Prepares the parts of these pairs, and no others: what a search needs takes ten times the memory of a
  /// facet.
  void prepare(const Batch& batch, const Threads& threads);

  /// Visits pairs of facets of two parts, as indices of Elements::all, that may meet in more than a common
  /// vertex, until `visit` returns false. The parts must be prepared.
  using Visit = std::function<bool(Index i, Index j)>;
  bool for_each(const std::array<Index, 2>& parts, const Visit& visit) const;

 private:
  static constexpr std::size_t kBlock = 1'000'000;  // facets

  struct Part {
    Index sheet = 0;
    bool is_round_origin = false, is_known = false, is_prepared = false;
    std::size_t block = 0;
    std::vector<Index> facets;
    Box box{};
    AabbTree tree;                              // of the facets' boxes
    std::vector<std::array<Point, 3>> corners;  // of the tree's items, contiguous in memory
    std::vector<Triangle> vertices;             // likewise
    Point normal{};
    double offset = 0;
    double most = 0, most_share = 0;  // |h(x)| <= most + most_share |x| on all facets
  };
  /// How flat a facet lies in its sheet, seen from one of its corners: t, and (t / r)^2.
  struct Flatness {
    double layer, share;
  };
  /// A facet that touches the plane of another part.
  struct Near {
    Box box;          // of its portion near that plane
    Index element;    // of Elements::all
    Index vertex;     // the only near corner, or `no_index`
    double rise = 0;  // m, and (m / l)^2
    double slope = 0;
    Flatness flatness{};  // at this corner
  };
  /// Such facets at one vertex, or a single facet.
  struct Fan {
    Box box;
    Index first, last;  // of Touching::elements
    Index vertex;       // or `no_index`
    double rise, slope;
    Flatness flatness;
  };
  /// Sets round a part.
  struct Round {
    OrientedBox box;
    RoundTriangle triangle;
  };
  struct Touching {
    std::vector<Index> elements;
    std::vector<Fan> fans;
  };
  class Sweep;

  void divide(std::span<const Index> sheet, std::span<const std::uint8_t> known);
  [[nodiscard]] bool is_round_origin(const Triangle& facet) const;
  void number_blocks(std::size_t block);
  void list_pairs(std::size_t most);
  void list_batches();
  [[nodiscard]] std::vector<Round> rounds(const Box& all) const;
  void measure(Part& part) const;
  static void forget(Part& part);
  [[nodiscard]] static bool is_beyond(const Box& box, const Part& plane);
  [[nodiscard]] static Touching touching(const Part& part, const Part& plane, const Box& box);
  [[nodiscard]] static bool find_near(const Part& part, std::size_t item, const Part& plane, Near& near);
  [[nodiscard]] static Flatness flatness(const Part& part, const std::array<Point, 3>& corners,
                                         std::size_t corner);

  const Complex& complex_;
  const Elements& elements_;
  std::vector<Part> parts_;
  std::vector<std::array<Index, 2>> pairs_;
  std::vector<Batch> batches_;
  bool too_many_ = false;
};

}  // namespace holdfast
