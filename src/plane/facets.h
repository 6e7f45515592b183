// Polygons and facets in space: their triangles or their planes. For readers of files, which use only this
// header of the layer.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "holdfast/plane.h"
#include "plane/triangles.h"

namespace holdfast::plane {

/// Outlines, segments and points in one plane, like a facet of a .poly.
struct PolygonFacet {
  std::vector<std::vector<Index>> polygons;
  std::vector<Point> holes;
};

/// The triangles of a "face" of any number of corners, or why it has none.
struct CutPolygon {
  std::vector<Triangle> triangles;  ///< empty if there is a `reason`
  std::string reason;
  double deviation = 0;  ///< largest distance of a corner from the mean plane; 0 if rounding explains it
};

/// The triangles of a polygon of at least four places, with its orientation. A polygon that is convex, seen
/// along its mean normal, becomes a fan; any other becomes constrained Delaunay triangles in the coordinate
/// plane least inclined to its own, with all corners kept and independent of the first corner. A polygon that
/// is not convex must lie in a plane, up to rounding of its coordinates to six digits or to `tolerance`, and
/// its sides must not cross.
[[nodiscard]] CutPolygon cut_polygon(std::span<const Point> vertices, std::span<const Index> corners,
                                     double tolerance, const Poll& poll);

/// The triangles of all that the polygons of a facet enclose, except the regions of its holes. They are
/// oriented as its first polygon of three corners or more.
[[nodiscard]] CutPolygon cut_facet(std::span<const Point> vertices, const PolygonFacet& facet,
                                   double tolerance, const Poll& poll);

/// The planes of facets, or the number (from 0) of a facet that lies in no plane, and the reason.
struct FoundPlanes {
  PlanesInSpace planes;  ///< without points and remarks
  double deviation = 0;  ///< as in CutPolygon
  std::size_t facet = 0;
  std::string reason;
};
/// One plane for all facets if possible, otherwise one for each facet.
[[nodiscard]] FoundPlanes planes_of(std::span<const Point> vertices, const std::vector<PolygonFacet>& facets,
                                    double tolerance, const Poll& poll);

}  // namespace holdfast::plane
