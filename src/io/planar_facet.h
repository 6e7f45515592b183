// Facets that are more than a convex polygon: of any outline, with holes, with segments and points inside.
#pragma once

#include <functional>
#include <vector>

#include "io/mesh_data.h"

namespace holdfast::io {

struct PlanarFacet {
  std::vector<std::vector<Index>> polygons;  ///< outlines; two corners are a segment, one is a point
  std::vector<Point> holes;                  ///< a point in each
  int marker = 0;
};

/// Whether it takes a triangulation: with holes, with segments or points beside outlines, or with an outline
/// that is not convex. Convex polygons alone are polygons of their own, which need not be in one plane.
[[nodiscard]] bool needs_triangulation(const std::vector<Point>& vertices, const PlanarFacet& facet);

/// Adds triangles that keep every outline, segment and point of the facet, and its segments. They turn as the
/// first outline does. It is projected along the axis nearest to its normal, and the projection decides;
/// exact planes are not needed. `fail` is called with the reason, and must throw, where outlines cross or
/// touch.
void add_planar_facet(MeshData& mesh, const PlanarFacet& facet, const Limits& limits,
                      const std::function<void(const std::string&)>& fail);

}  // namespace holdfast::io
