// The exact arrangement of a complex: elements are cut where they meet, so that the result is a complex
// again. Nothing is rounded.
//
// The search (surface/search.h) finds pairs of elements that do not fit. The exact contacts of a pair give
// its intersection, whose ends are vertices or new points: a side pierces a facet, or two sides cross. Facets
// of one plane that share area form a sheet, triangulated once. Any other facet that something meets is a
// sheet of its own (sheet.h). If three facets meet in a point, each of their sheets finds the point as the
// crossing of two traces, and the pool of points makes it one. So two sheets agree along their common line:
// an element that cuts the line in one sheet meets the other sheet there, too.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/packed_point.h"
#include "holdfast/types.h"
#include "mesh/parallel.h"
#include "surface/elements.h"
#include "surface/search.h"

namespace holdfast::arrange {

/// Lists of parents, one list an entity.
struct Parents {
  std::vector<Index> first{0};  ///< where each list begins in `all`, and where the last one ends
  std::vector<Index> all;

  [[nodiscard]] std::size_t size() const { return first.size() - 1; }
  [[nodiscard]] std::span<const Index> of(std::size_t i) const {
    return {all.data() + first[i], all.data() + first[i + 1]};
  }
  void add(std::span<const Index> parents) {
    all.insert(all.end(), parents.begin(), parents.end());
    first.push_back(static_cast<Index>(all.size()));
  }
};

struct Arrangement {
  // Points that are not vertices of the complex: if the complex has n vertices, point k is vertex n + k
  // below.
  std::vector<Point> nearest;              ///< the doubles nearest to each point
  std::vector<double> distances;           ///< of each point from these, rounded up
  std::vector<exact::PackedPoint> points;  ///< if ArrangeOptions::keeps_points
  /// In the order and orientation of their first parents. Corners are the first vertices at their places.
  std::vector<Triangle> facets;
  Parents facet_parents;  ///< facets of the complex, in ascending order: several where these overlapped
  /// For each facet, its sheet if the sheet's facets still fit together with all corners at their nearest
  /// doubles; else `no_index`.
  std::vector<Index> facet_sheet;
  std::size_t sheets = 0;
  std::vector<Segment> segments;  ///< pieces of the complex's segments, each once
  Parents segment_parents;
  /// Degenerate facets and segments of the complex, which are left out: see Elements::flaws.
  std::vector<Flaw> left_out;
  std::size_t pairs = 0;  ///< of elements that did not fit
  /// For each facet of the complex, whether it fitted together with all other facets marked so.
  std::vector<std::uint8_t> fitted;
  bool is_same = false;  ///< there was nothing to do; the members above stay empty
};

struct ArrangeOptions {
  Threads threads = 1;
  Known known = {};                    ///< see surface/search.h
  std::size_t most_points = SIZE_MAX;  ///< new ones; more of them throw TooManyPoints
  std::size_t most_pairs = SIZE_MAX;   ///< that do not fit; more of them throw TooManyPoints, too
  bool keeps_points = false;           ///< the exact new points are asked for

  /// With too many points, whether there are more than this matters, too.
  std::size_t counts_to = 0;

  /// So many points of one sheet are too many, without a look at others.
  [[nodiscard]] std::size_t far_too_many() const { return std::max(most_points, counts_to); }
};

class TooManyPoints : public std::exception {
 public:
  explicit TooManyPoints(std::size_t count) : count_(count) {}
  [[nodiscard]] std::size_t count() const { return count_; }
  /// Arrangement::fitted, if all pairs had been found; else empty.
  std::vector<std::uint8_t> fitted;
  [[nodiscard]] const char* what() const noexcept override { return "the arrangement has too many points"; }

 private:
  std::size_t count_;
};

/// `elements` are the complex's. `step` is called from time to time from the calling thread, with the share
/// of the work that is done; it may throw. The result does not depend on the number of threads.
[[nodiscard]] Arrangement arrange(const Complex& complex, const Elements& elements, const Step& step,
                                  const ArrangeOptions& options = {});

}  // namespace holdfast::arrange
