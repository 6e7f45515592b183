// The exact arrangement of a complex: its elements cut where they meet, so that what comes out is a complex
// again. Nothing is rounded.
//
// Pairs of elements that do not fit come from the search (surface/search.h), and what the two have in common
// from their exact contacts. Its ends are vertices or new points: where a side pierces a facet, or two sides
// cross. Facets of one plane that share area are one sheet, triangulated once; any other facet that something
// meets is a sheet of its own (sheet.h). Where three facets meet in a point, each of their sheets finds it as
// the crossing of two traces; the pool of points makes it one. So two sheets agree along their common lines:
// whatever cuts the line in one of them is an element that meets the other there, too.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "exact/space_point.h"
#include "holdfast/types.h"
#include "mesh/parallel.h"
#include "surface/elements.h"
#include "surface/search.h"

namespace holdfast::arrange {

/// Lists of parents, one list an entity.
struct Parents {
  std::vector<Index> first{0};  ///< where each list begins in `all`, and where the last ends
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
  /// Points that are no vertices of the complex: if it has n, point k is vertex n + k of what follows.
  std::vector<exact::SpacePoint> points;
  std::vector<Point> nearest;  ///< the doubles nearest to each
  /// In the order of their first parents, turned as these. Corners are the first vertices at their places.
  std::vector<Triangle> facets;
  Parents facet_parents;  ///< facets of the complex, in ascending order: several where these overlapped
  /// For each facet its sheet, if the facets of that fit together where their corners stand at the nearest
  /// doubles, too; else `no_index`.
  std::vector<Index> facet_sheet;
  std::size_t sheets = 0;
  std::vector<Segment> segments;  ///< pieces of the complex's, each once
  Parents segment_parents;
  /// Facets and segments of the complex that are left out, as they are none: see Elements::flaws.
  std::vector<Flaw> left_out;
  std::size_t pairs = 0;  ///< of elements that did not fit
  /// For each facet of the complex whether it fitted together with all others of which that is said.
  std::vector<std::uint8_t> fitted;
  bool is_same = false;  ///< there was nothing to do, and nothing of the above is filled in
};

struct ArrangeOptions {
  Threads threads = 1;
  Known known = {};                    ///< see surface/search.h
  std::size_t most_points = SIZE_MAX;  ///< new ones; more of them throw TooManyPoints
};

class TooManyPoints : public std::exception {
 public:
  explicit TooManyPoints(std::size_t count) : count_(count) {}
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const char* what() const noexcept override { return "the arrangement has too many points"; }

 private:
  std::size_t count_;
};

/// `elements` are the complex's. `step` is called now and then from the calling thread with the share of the
/// work that is done, and may throw. The result does not depend on the threads.
[[nodiscard]] Arrangement arrange(const Complex& complex, const Elements& elements, const Step& step,
                                  const ArrangeOptions& options = {});

}  // namespace holdfast::arrange
