// Polygons of more than three corners, and facets of several polygons, which some formats carry.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/mesh_data.h"

namespace holdfast::io {

/// What long work on polygons calls now and then.
[[nodiscard]] inline plane::Poll poll_of(Watch* watch) {
  return [watch](double) { step(watch); };
}

/// The corners without those at the place of the one before them, which the first follows.
[[nodiscard]] std::vector<Index> without_repeats(std::span<const Point> vertices,
                                                 std::span<const Index> corners);

/// Adds a "face" of any number of corners to `mesh`: a triangle as it is, two corners as a segment,
/// one as nothing more than the vertex that it names, more as plane::cut_polygon has it. A corner that
/// repeats the place of the one before it does not count. `fail` is called with the reason, and must throw,
/// if there are no triangles.
template <typename Fail>
void add_polygon(MeshData& mesh, std::span<const Index> corners, int marker, Fail&& fail) {
  if (mesh.keeps_polygons && !corners.empty()) {
    mesh.polygons.push_back({{{corners.begin(), corners.end()}}, {}});
    return;
  }
  switch (corners.size()) {
    case 0:
      fail("a face without corners");
      return;
    case 1:
      return;
    case 2:
      mesh.add_segment({corners[0], corners[1]}, marker);
      return;
    case 3:
      mesh.add_facet({corners[0], corners[1], corners[2]}, marker);
      return;
    default:
      break;
  }
  const std::vector<Index> distinct = without_repeats(mesh.vertices, corners);
  if (distinct.size() <= 3) {  // of one or two places: a triangle that `diagnose` calls degenerate
    const std::span<const Index> triangle = distinct.size() == 3 ? std::span<const Index>(distinct) : corners;
    return mesh.add_facet({triangle[0], triangle[1], triangle[2]}, marker);
  }
  const plane::CutPolygon cut =
      plane::cut_polygon(mesh.vertices, distinct, mesh.tolerance, poll_of(mesh.watch));
  if (!cut.reason.empty()) fail("a polygon of " + std::to_string(corners.size()) + " corners " + cut.reason);
  mesh.add_cut(cut.triangles, cut.deviation, marker);
}

/// Adds the triangles of a strip: corners i, i + 1, i + 2, with every other one turned round. Those that name
/// a vertex twice only join strips.
inline void add_strip(MeshData& mesh, std::span<const Index> corners, int marker) {
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    const Triangle triangle{corners[i + i % 2], corners[i + 1 - i % 2], corners[i + 2]};
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
      mesh.add_facet(triangle, marker);
  }
}

}  // namespace holdfast::io
