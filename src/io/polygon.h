// Polygons of more than three corners and facets of several polygons, which some formats contain.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/mesh_data.h"

namespace holdfast::io {

/// Polled now and then by long work on polygons.
[[nodiscard]] inline plane::Poll poll_of(Watch* watch) {
  return [watch](double) { step(watch); };
}

/// Adds a "face" of any number of corners to `mesh`: a triangle unchanged, two corners as a segment, one
/// corner as nothing but the vertex it names, more corners by plane::cut_polygon. A corner at the place of
/// its predecessor does not count. If there is no corner, `fail` is called with the reason, and must throw.
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
  const plane::CutPolygon cut = plane::cut_polygon(mesh.vertices, corners, poll_of(mesh.watch));
  if (cut.triangles.size() == 1 && !cut.crosses) return mesh.add_facet(cut.triangles[0], marker);
  mesh.add_cut(cut.triangles, cut.deviation, marker);
  if (cut.crosses) ++mesh.polygon_counts.crossing;
}

/// The same in formats in which a face of fewer than three corners is no segment: it is left out.
template <typename Fail>
void add_face(MeshData& mesh, std::span<const Index> corners, int marker, Fail&& fail) {
  if (corners.size() < 3)
    ++mesh.polygon_counts.left_out;
  else
    add_polygon(mesh, corners, marker, fail);
}

/// Adds the triangles of a strip: corners i, i + 1, i + 2, with every other one reversed. Triangles that name
/// a vertex twice only join strips and are left out.
inline void add_strip(MeshData& mesh, std::span<const Index> corners, int marker) {
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    const Triangle triangle{corners[i + i % 2], corners[i + 1 - i % 2], corners[i + 2]};
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
      mesh.add_facet(triangle, marker);
  }
}

}  // namespace holdfast::io
