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

/// The triangles of a polygon.
struct CutPolygon {
  std::vector<Triangle> triangles;
  double deviation = 0;  ///< largest distance of a corner from the mean plane; 0 if rounding explains it
  bool crosses = false;  ///< its sides cross or overlap, seen along its normal
};

/// The triangles of a polygon of at least three corners, with its orientation. A corner at the place of the
/// one before it does not count; what then has at most three corners becomes one triangle.
/// - If it is convex, seen along its mean normal, it becomes a fan.
/// - If its sides do not cross in the coordinate plane least inclined to its own (or else in another, if it
///   is not plane), it becomes constrained Delaunay triangles in that plane, with all corners kept.
/// - Otherwise it becomes triangles of least area (least_area.h), which may cross each other.
/// - If it is straight, has a corner that is not finite, or crosses itself and has more corners than
///   triangles of least area allow, it becomes a fan: no better one is known, and `diagnose` says what is
///   wrong.
[[nodiscard]] CutPolygon cut_polygon(std::span<const Point> vertices, std::span<const Index> corners,
                                     const Poll& poll);

/// The triangles of a facet, or why it has none.
struct CutFacet {
  std::vector<Triangle> triangles;  ///< empty if there is a `reason`
  std::string reason;
  double deviation = 0;  ///< as in CutPolygon
};

/// The triangles of all that the polygons of a facet enclose, except the regions of its holes. They are
/// oriented as its first polygon of three corners or more. The facet must lie in a plane, up to rounding of
/// its coordinates to six digits (if it has holes) or to `tolerance`.
[[nodiscard]] CutFacet cut_facet(std::span<const Point> vertices, const PolygonFacet& facet, double tolerance,
                                 const Poll& poll);

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

/// Puts markers of vertices and segments, one each or none, on the points and segments of a plane at their
/// places. Of several at one place, the first that is not 0 counts.
void mark(PlanesInSpace::Part& part, std::span<const Point> vertices, std::span<const int> vertex_markers,
          std::span<const Segment> segments, std::span<const int> segment_markers);

}  // namespace holdfast::plane
