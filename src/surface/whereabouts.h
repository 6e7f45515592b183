// Surface layer: what the facets alone tell of where points lie, before there is any mesh.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "holdfast/types.h"

namespace holdfast {

enum class Whereabouts : std::uint8_t {
  on_facet,   ///< in the closed triangle of some facet
  unbounded,  ///< on no facet, and joined to infinity by a line along an axis that meets none
  open,       ///< only a mesh can tell
};

/// Exact. Coordinates of vertices and points must be finite, and indices in range; facets of zero area are
/// passed over. `step` is called for each facet.
[[nodiscard]] std::vector<Whereabouts> whereabouts(const Complex& complex, std::span<const Point> points,
                                                   const std::function<void()>& step);

}  // namespace holdfast
