// Where three facets cross each other: each of their sheets finds the point as the crossing of two traces,
// and it is computed once.
#pragma once

#include <array>
#include <deque>
#include <mutex>

#include "arrange/facet_planes.h"
#include "arrange/index_table.h"
#include "exact/space_point.h"
#include "holdfast/types.h"

namespace holdfast::arrange {

struct CrossingPoint {
  exact::SpacePoint point;
  Point nearest;            ///< the doubles nearest to it
  Index number = no_index;  ///< in the pool of points, once it is there
};

/// May be used by several threads. Points stay where they are, and do not depend on who asks first.
class Crossings {
 public:
  explicit Crossings(const FacetPlanes& planes) : planes_(planes) {}

  [[nodiscard]] const exact::SpacePlane& plane_of(Index facet) const { return planes_[facet]; }
  /// The point of the planes of three facets, which are indices of Elements::all.
  CrossingPoint& of_facets(std::array<Index, 3> facets);
  /// Some other point.
  CrossingPoint& add(exact::SpacePoint point);

 private:
  /// Points by the facets that make them, in parts that are locked one by one.
  struct Part {
    std::mutex mutex;
    std::deque<CrossingPoint> all;
    IndexTable<3> of_facets;  // into `all`
  };

  const FacetPlanes& planes_;
  std::array<Part, 64> parts_;
};

}  // namespace holdfast::arrange
