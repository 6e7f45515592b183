// A complex, a mesh that is to conform to it, and the conditions that the mesh must satisfy then.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "enforce/enforce.h"
#include "hard_surfaces.h"
#include "mesh/assembly.h"
#include "mesh/validate.h"
#include "mesh_fixtures.h"

namespace holdfast::testing {

using exact::Dyadic;
using Random = std::mt19937_64;
using Ends = std::array<Vertex, 2>;

// A complex, and the Delaunay mesh of its vertices, the corners of a box, and some Steiner points.
struct Task {
  Surface surface;
  TetMesh mesh;
  SegmentTable table;
  Standing standing;
  Vertex first_free = 0;
  Dyadic volume;
};

Task task(const Surface& surface, const std::vector<Point>& steiner = {}) {
  Task t;
  t.surface = surface;
  double reach = 0;
  for (const Point& p : surface.vertices) {
    MeshEditor(t.mesh).add_vertex(p);
    for (const double x : p) reach = std::max(reach, 2 * std::abs(x));
  }
  for (unsigned k = 0; k < 8; ++k)
    MeshEditor(t.mesh).add_vertex(Point{(k & 1u) != 0 ? reach : -reach, (k & 2u) != 0 ? reach : -reach,
                                        (k & 4u) != 0 ? reach : -reach});
  t.first_free = static_cast<Vertex>(t.mesh.vertex_count());
  for (const Point& p : steiner) MeshEditor(t.mesh).add_vertex(p);
  EXPECT_TRUE(build_delaunay(t.mesh, {}, nullptr));
  t.table = segment_table(surface.view());
  t.standing = mark_present(t.mesh, t.table);
  t.volume = volume_of(t.mesh);
  return t;
}

inline EnforceStats run(Task& t, const EnforceOptions& how) {
  const Options options;
  Monitor monitor(options);
  return enforce(t.mesh, {t.table, t.surface.facets, t.standing}, t.first_free, how, monitor);
}

// --- exact positions

inline bool on_line(const TetMesh& mesh, Vertex a, Vertex b, Vertex v) {
  for (int axis = 0; axis < 3; ++axis)
    if (exact::orient2d(mesh.point(a), mesh.point(b), mesh.point(v), axis) != 0) return false;
  return true;
}

// Orders the points of the line ab from a to b.
inline bool before(const TetMesh& mesh, Vertex a, Vertex b, Vertex v, Vertex w) {
  const auto pa = mesh.exact_position(a), pb = mesh.exact_position(b);
  const auto pv = mesh.exact_position(v), pw = mesh.exact_position(w);
  for (std::size_t k = 0; k < 3; ++k)
    if (pa.c[k] != pb.c[k]) return pa.c[k] < pb.c[k] ? pv.c[k] < pw.c[k] : pw.c[k] < pv.c[k];
  return false;
}

// All vertices of the mesh on the closed segment ab, from a to b.
inline std::vector<Vertex> vertices_on(const TetMesh& mesh, Vertex a, Vertex b) {
  std::vector<Vertex> out;
  for (Vertex v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.in_mesh(v) && on_line(mesh, a, b, v) && !before(mesh, a, b, v, a) && !before(mesh, a, b, b, v))
      out.push_back(v);
  std::sort(out.begin(), out.end(), [&](Vertex v, Vertex w) { return before(mesh, a, b, v, w); });
  return out;
}

// A facet, oriented so that `above` sees it positively.
struct Plane {
  Triangle corners{};
  Vertex above = 0;

  inline Plane(const Task& t, const Triangle& f) : corners(f), above(t.first_free - 8) {
    while (t.mesh.orient(f[0], f[1], f[2], above) == 0) ++above;
    if (t.mesh.orient(f[0], f[1], f[2], above) < 0) std::swap(corners[1], corners[2]);
  }
  [[nodiscard]] bool holds(const TetMesh& mesh, Vertex v) const {
    const auto [a, b, c] = corners;
    return mesh.orient(a, b, c, v) == 0 && mesh.orient(a, b, v, above) >= 0 &&
           mesh.orient(b, c, v, above) >= 0 && mesh.orient(c, a, v, above) >= 0;
  }
  [[nodiscard]] bool holds(const TetMesh& mesh, const FaceKey& f) const {
    return holds(mesh, f[0]) && holds(mesh, f[1]) && holds(mesh, f[2]);
  }
};

// Faces of a mesh do not overlap, so they cover a facet if they lie in it and their areas add up to its area;
// volumes under one apex stand for areas.
inline std::size_t expect_covered(const Task& t, const Triangle& facet, const std::set<FaceKey>& faces) {
  const Plane plane(t, facet);
  std::vector<TetMesh::Corners> pieces;
  for (const FaceKey& f : faces) {
    if (!plane.holds(t.mesh, f)) continue;
    const bool turned = t.mesh.orient(f[0], f[1], f[2], plane.above) < 0;
    pieces.push_back({f[0], f[turned ? 2 : 1], f[turned ? 1 : 2], plane.above});
  }
  EXPECT_TRUE(all_positive(t.mesh, pieces));
  const auto [a, b, c] = plane.corners;
  const std::vector<TetMesh::Corners> whole{{a, b, c, plane.above}};
  EXPECT_EQ(volume_of(t.mesh, pieces), volume_of(t.mesh, whole));
  return pieces.size();
}

// Every segment is a chain of segment edges, every facet is covered by facet faces, and there are no other
// such edges or faces.
inline void expect_laid(const Task& t) {
  ASSERT_EQ(find_fault(t.mesh), "");
  ASSERT_EQ(volume_of(t.mesh), t.volume);
  std::size_t exact_ones = 0;
  for (Vertex v = t.first_free; v < t.mesh.vertex_count(); ++v)
    exact_ones += t.mesh.in_mesh(v) && !t.mesh.is_explicit(v) ? 1 : 0;
  ASSERT_EQ(t.mesh.exact_vertex_count(), exact_ones);
  std::set<EdgeEnds> chains;
  for (const auto& [a, b] : t.table.segments) {
    const std::vector<Vertex> chain = vertices_on(t.mesh, a, b);
    for (std::size_t k = 1; k < chain.size(); ++k) chains.insert(sorted(EdgeEnds{chain[k - 1], chain[k]}));
  }
  ASSERT_EQ(segment_edges(t.mesh), chains);
  const std::set<FaceKey> faces = facet_faces(t.mesh);
  std::size_t pieces = 0;
  for (const Triangle& f : t.surface.facets) pieces += expect_covered(t, f, faces);
  ASSERT_EQ(pieces, faces.size());
}

inline void expect_off_constraints(const Task& t, Vertex v) {
  for (const auto& [a, b] : t.table.segments)
    ASSERT_FALSE(on_line(t.mesh, a, b, v) && !before(t.mesh, a, b, v, a) && !before(t.mesh, a, b, b, v));
  for (const Triangle& f : t.surface.facets) ASSERT_FALSE(Plane(t, f).holds(t.mesh, v));
}

// Every segment is one edge, every facet is one face, and no Steiner point is on them.
inline void expect_enforced(const Task& t) {
  expect_laid(t);
  std::set<FaceKey> facets;
  for (const Triangle& f : t.surface.facets) facets.insert(sorted(FaceKey{f[0], f[1], f[2]}));
  std::set<EdgeEnds> segments;
  for (const auto& [a, b] : t.table.segments) segments.insert(sorted(EdgeEnds{a, b}));
  EXPECT_EQ(facet_faces(t.mesh), facets);
  EXPECT_EQ(segment_edges(t.mesh), segments);
  for (Vertex v = t.first_free; v < t.mesh.vertex_count(); ++v)
    if (t.mesh.in_mesh(v)) expect_off_constraints(t, v);
}

// k triangles round the segment 0 1 in a cloud of points: evenly, at random, or all in one quarter.
inline Surface pages(int k, std::uint64_t seed) {
  Random random(seed);
  Surface surface;
  surface.vertices = {{0, 0, -1}, {0, 0, 1}};
  for (int i = 0; i < k; ++i) {
    const double even = 2 * hard::kPi * i / k;
    const double angle = seed % 3 == 0 ? even : seed % 3 == 1 ? even / 4 : even + hard::uniform(random, 0, 1);
    surface.vertices.push_back({std::cos(angle), std::sin(angle), hard::uniform(random, -0.9, 0.9)});
    surface.facets.push_back({0, 1, static_cast<Index>(i) + 2});
  }
  if (k == 0) surface.segments = {{0, 1}};
  for (const Point& p : random_points(25, seed)) surface.vertices.push_back({0.6 * p[0], 0.6 * p[1], p[2]});
  return surface;
}

// A grid among random points: segments between its points also leave through edges.
inline std::vector<Point> points_and_grid(std::uint64_t seed) {
  std::vector<Point> points = random_points(40, seed);
  for (int k = 0; k < 27; ++k)
    points.push_back({0.25 * (k % 3 - 1), 0.25 * (k / 3 % 3 - 1), 0.25 * (k / 9 - 1)});
  return points;
}

// The facet 0 1 2 among random points, grid points and, with `trap`, Steiner points inside it.
inline Task facet_task(std::uint64_t seed, bool trap) {
  Surface surface;
  surface.vertices = {{-1, 0.75, 0.125}, {1, 0.5, 0.125}, {0.125, -1, 0.125}};
  for (const Point& p : points_and_grid(seed)) surface.vertices.push_back({p[0], p[1], p[2] + 0.03125});
  surface.facets = {{0, 1, 2}};
  if (!trap) return task(surface);
  return task(surface, {{0, 0, 0.125}, {0.25, 0.25, 0.125}, {0, 0.625, 0.125}});  // the last one on a side
}

}  // namespace holdfast::testing
