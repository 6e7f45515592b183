// Where three facets cross each other: each of their sheets finds the point as the crossing of two traces,
// and it is computed once.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <mutex>
#include <span>
#include <vector>

#include "exact/space_point.h"
#include "holdfast/types.h"
#include "mesh/parallel.h"
#include "surface/complex.h"
#include "surface/elements.h"

namespace holdfast::arrange {

struct CrossingPoint {
  exact::SpacePoint point;
  Point nearest;            ///< the doubles nearest to it
  Index number = no_index;  ///< in the pool of points, once it is there
};

/// May be used by several threads. Points stay where they are, and do not depend on who asks first.
class Crossings {
 public:
  /// `cut`: for each element whether it is a facet whose plane will be asked for.
  Crossings(const Complex& complex, const Elements& elements, const std::vector<std::uint8_t>& cut,
            const Threads& threads);

  [[nodiscard]] const exact::SpacePlane& plane_of(Index facet) const { return planes_[plane_[facet]]; }
  /// The point of the planes of three facets, which are indices of Elements::all.
  CrossingPoint& of_facets(std::array<Index, 3> facets);
  /// Some other point.
  CrossingPoint& add(exact::SpacePoint point);

 private:
  /// Points by the facets that make them, in parts that are locked one by one.
  struct Part {
    std::mutex mutex;
    std::map<std::array<Index, 3>, CrossingPoint*> of_facets;
    std::deque<CrossingPoint> all;
  };

  std::vector<Index> plane_;  // by element
  std::vector<exact::SpacePlane> planes_;
  std::array<Part, 64> parts_;
};

}  // namespace holdfast::arrange
