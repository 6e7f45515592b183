// Surface layer: locates points by the facets alone, before there is a mesh.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "holdfast/types.h"
#include "surface/separation.h"

namespace holdfast {

struct Whereabouts {
  bool on_facet = false;      ///< in the closed triangle of a facet
  Separation::Region region;  ///< the region of any other point; empty for the unbounded one
};

/// Exact. Coordinates of vertices and points must be finite, and indices in range; facets of zero area are
/// skipped. `separation` is that of the complex; regions are meaningful if the complex is valid. `step` is
/// called for each facet.
[[nodiscard]] std::vector<Whereabouts> whereabouts(const Complex& complex, const Separation& separation,
                                                   std::span<const Point> points,
                                                   const std::function<void()>& step);

}  // namespace holdfast
