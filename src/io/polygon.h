// Polygons of more than three corners, which some formats carry.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/mesh_data.h"

namespace holdfast::io {

/// The fan of triangles that covers a convex polygon, in its orientation; empty if the polygon is
/// not convex, seen along its mean normal, or no corner sees every other without a flat triangle.
///
/// This is decided in floating point, which is harmless: it only chooses between a fan and an error,
/// and `diagnose` then judges the triangles exactly.
[[nodiscard]] std::vector<Triangle> fan(std::span<const Point> vertices, std::span<const Index> corners);

/// The corners without those at the place of the one before them, which the first follows.
[[nodiscard]] std::vector<Index> without_repeats(std::span<const Point> vertices,
                                                 std::span<const Index> corners);

/// Adds a "face" of any number of corners to `mesh`: a triangle as it is, two corners as a segment,
/// one as nothing more than the vertex that it names, more as a fan. A corner that repeats the place of the
/// one before it does not count. `fail` is called with the reason, and must throw, if the polygon cannot be
/// fanned.
template <typename Fail>
void add_polygon(MeshData& mesh, std::span<const Index> corners, int marker, Fail&& fail) {
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
  const std::vector<Triangle> triangles = fan(mesh.vertices, distinct);
  if (triangles.empty())
    fail("a polygon of " + std::to_string(corners.size()) +
         " corners that is not convex; split it into triangles");
  for (const Triangle& triangle : triangles) mesh.add_facet(triangle, marker);
  ++mesh.polygons_cut;
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
