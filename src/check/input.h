// Check: the input as the mesh should have it. Vertices at one place are one vertex, and a mesh begins with
// the distinct places, in the order of their first vertices.
#pragma once

#include <span>
#include <vector>

#include "check/pulse.h"
#include "holdfast/types.h"

namespace holdfast::checking {

/// Stands for a vertex that the mesh leaves out, or that does not exist.
inline constexpr Index no_vertex = ~Index{0};

/// Facets and segments here name vertices of the mesh; their own indices are those of the surface.
struct Input {
  /// For each distinct place the first of the surface's vertices there that a facet or segment uses, else the
  /// first. What is unused and not finite, or at the place of another vertex, is left out.
  std::vector<Index> first;
  std::vector<Index> vertex;  ///< by vertex of the surface that of the mesh, or `no_vertex`
  std::vector<Triangle> facets;
  std::vector<Segment> segments;
};

/// Any indices and coordinates are accepted.
[[nodiscard]] Input input_of(const Complex& surface, Pulse& pulse);

}  // namespace holdfast::checking
