// Check: the input as the mesh should contain it. Vertices at one place are one vertex. A mesh begins with
// the distinct places, in the order of their first vertices.
#pragma once

#include <span>
#include <vector>

#include "check/pulse.h"
#include "holdfast/types.h"

namespace holdfast::checking {

/// Stands for a vertex that is left out of the mesh or does not exist.
inline constexpr Index no_vertex = ~Index{0};

/// Facets and segments of the input by vertices of the mesh; they keep the order of the surface.
struct Input {
  /// For each distinct place, the first vertex of the surface there that a facet or segment uses, or else the
  /// first one. An unused vertex is left out if it is not finite or shares its place with another vertex.
  std::vector<Index> first;
  std::vector<Index> vertex;  ///< for each vertex of the surface, that of the mesh, or `no_vertex`
  std::vector<Triangle> facets;
  std::vector<Segment> segments;
};

/// All indices and coordinates are accepted.
[[nodiscard]] Input input_of(const Complex& surface, Pulse& pulse);

}  // namespace holdfast::checking
