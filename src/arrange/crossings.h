// Points where three facets cross. Each of the three sheets finds the point as the crossing of two traces; it
// is computed once.
#pragma once

#include <array>
#include <deque>
#include <mutex>

#include "arrange/facet_planes.h"
#include "arrange/index_table.h"
#include "exact/packed_point.h"
#include "holdfast/types.h"

namespace holdfast::arrange {

struct CrossingPoint {
  exact::PackedPoint point;
  Point nearest;            ///< the doubles nearest to it
  Index number = no_index;  ///< in the pool of points, once it is there
};

/// Thread-safe. Points keep their address, and do not depend on which thread asks first.
class Crossings {
 public:
  explicit Crossings(const FacetPlanes& planes) : planes_(planes) {}

  [[nodiscard]] const exact::SpacePlane& plane_of(Index facet) const { return planes_[facet]; }
  /// The point of the planes of three facets, which are indices of Elements::all.
  CrossingPoint& of_facets(std::array<Index, 3> facets);
  /// Some other point.
  CrossingPoint& add(const exact::SpacePoint& point);

 private:
  /// Points by the facets that define them, in shards with a lock each.
  struct Part {
    std::mutex mutex;
    std::deque<CrossingPoint> all;
    IndexTable<3> of_facets;  // into `all`
  };

  const FacetPlanes& planes_;
  std::array<Part, 64> parts_;
};

}  // namespace holdfast::arrange
