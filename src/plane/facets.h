// Polygons and facets in space: the triangles of each, or their planes. For readers of files, which use only
// this header of the layer.
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

/// A "face" of any number of corners, or why it cannot be one.
struct CutPolygon {
  std::vector<Triangle> triangles;  ///< empty if `reason` is not
  std::string reason;
  double deviation = 0;  ///< largest distance of a corner from the mean plane; 0 where rounding explains it
};

/// The triangles of a polygon of four places or more, turned as it is: a fan if it is convex, seen along its
/// mean normal; else constrained Delaunay triangles in the coordinate plane that its plane leans from least,
/// the same whatever corner comes first, with all corners kept. A polygon that is not convex must lie in a
/// plane, up to the rounding of its coordinates to six digits or to `tolerance`, and its sides must not
/// cross.
[[nodiscard]] CutPolygon cut_polygon(std::span<const Point> vertices, std::span<const Index> corners,
                                     double tolerance, const Poll& poll);

/// The triangles of all that the polygons of a facet enclose but the regions of its holes, turned as its
/// first polygon of three corners or more.
[[nodiscard]] CutPolygon cut_facet(std::span<const Point> vertices, const PolygonFacet& facet,
                                   double tolerance, const Poll& poll);

/// The planes of facets, or the number (from 0) of a facet that lies in no plane, and the reason.
struct FoundPlanes {
  PlanesInSpace planes;  ///< without points and remarks
  double deviation = 0;  ///< as of CutPolygon
  std::size_t facet = 0;
  std::string reason;
};
/// One plane for all facets if there is one, else one for each facet.
[[nodiscard]] FoundPlanes planes_of(std::span<const Point> vertices, const std::vector<PolygonFacet>& facets,
                                    double tolerance, const Poll& poll);

}  // namespace holdfast::plane
