// Meshes for tests of the layers above Delaunay, and what those tests ask of a mesh, by exhaustive search.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "delaunay/delaunay.h"
#include "exact/volume.h"
#include "mesh/editor.h"
#include "mesh/kernel.h"
#include "mesh/keys.h"
#include "mesh/tet_mesh.h"
#include "mesh/traverse.h"

namespace holdfast::testing {

using EdgeEnds = std::array<Vertex, 2>;

template <typename Key>
Key sorted(Key key) {
  std::sort(key.begin(), key.end());
  return key;
}

inline std::vector<Point> random_points(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<Point> points(n);
  for (Point& p : points)
    for (double& x : p) x = u(random);
  return points;
}

inline Point point_in_unit_cube(std::mt19937_64& random) {
  std::uniform_real_distribution<double> any(0, 1);
  const double x = any(random), y = any(random);
  return {x, y, any(random)};
}

inline std::vector<Point> corners_of_unit_cube() {
  std::vector<Point> points;
  for (unsigned k = 0; k < 8; ++k)
    points.push_back({(k & 1u) != 0 ? 1.0 : 0.0, (k & 2u) != 0 ? 1.0 : 0.0, (k & 4u) != 0 ? 1.0 : 0.0});
  return points;
}

// The Delaunay mesh of points and of the corners of a box round them, which come after the points.
inline TetMesh delaunay_in_box(const std::vector<Point>& points, double half_extent = 10) {
  TetMesh mesh;
  for (const Point& p : points) MeshEditor(mesh).add_vertex(p);
  for (unsigned k = 0; k < 8; ++k)
    MeshEditor(mesh).add_vertex(Point{(k & 1u) != 0 ? half_extent : -half_extent,
                                      (k & 2u) != 0 ? half_extent : -half_extent,
                                      (k & 4u) != 0 ? half_extent : -half_extent});
  EXPECT_TRUE(build_delaunay(mesh, {}, nullptr));
  return mesh;
}

// Points of a jittered grid, the jitter so small that Delaunay leaves slivers.
inline TetMesh slivers(double jitter, std::uint64_t seed, int n = 4) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> shift(-jitter, jitter);
  std::vector<Point> points;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) points.push_back({i + shift(random), j + shift(random), k + shift(random)});
  return delaunay_in_box(points, 2.0 * n);
}

inline std::vector<Tet> living(const TetMesh& mesh) {
  std::vector<Tet> tets;
  for (Tet t = 0; t < mesh.slot_count(); ++t)
    if (mesh.alive(t)) tets.push_back(t);
  return tets;
}

// Those that are no ghosts.
inline std::vector<Tet> solid(const TetMesh& mesh) {
  std::vector<Tet> tets = living(mesh);
  std::erase_if(tets, [&](Tet t) { return mesh.is_ghost(t); });
  return tets;
}

inline std::vector<Tet> living_with(const TetMesh& mesh, std::initializer_list<Vertex> vertices) {
  std::vector<Tet> tets;
  for (const Tet t : living(mesh))
    if (std::all_of(vertices.begin(), vertices.end(), [&](Vertex v) { return mesh.index_of(t, v) >= 0; }))
      tets.push_back(t);
  return tets;
}

inline std::vector<Tet> ball_of(TetMesh& mesh, Vertex v) {
  std::vector<Tet> tets;
  ball(mesh, v, tets);
  return tets;
}

inline std::vector<Tet> shell_of(TetMesh& mesh, Vertex a, Vertex b) {
  std::vector<Tet> tets;
  shell(mesh, find_edge(mesh, a, b), a, b, tets);
  return tets;
}

// The outer faces of a set of tetrahedra, as Kernel takes them.
inline std::vector<FaceKey> outer_faces(const TetMesh& mesh, std::span<const Tet> tets) {
  std::vector<FaceKey> faces;
  for (const Tet t : tets)
    for (int i = 0; i < 4; ++i)
      if (std::find(tets.begin(), tets.end(), tet_of(mesh.neighbour(t, i))) == tets.end())
        faces.push_back(mesh.face_vertices(face_code(t, i)));
  return faces;
}

inline std::vector<TetMesh::Corners> cone(std::span<const FaceKey> faces, Vertex apex) {
  std::vector<TetMesh::Corners> tets;
  for (const FaceKey& f : faces)
    if (std::find(f.begin(), f.end(), apex) == f.end()) tets.push_back({f[0], f[1], f[2], apex});
  return tets;
}

inline Kernel kernel_of(const TetMesh& mesh, std::span<const FaceKey> faces) {
  Kernel kernel(mesh);
  for (const FaceKey& f : faces) kernel.add(f[0], f[1], f[2]);
  return kernel;
}

inline bool all_positive(const TetMesh& mesh, std::span<const TetMesh::Corners> tets) {
  return std::all_of(tets.begin(), tets.end(),
                     [&](const auto& c) { return mesh.orient(c[0], c[1], c[2], c[3]) > 0; });
}

// Six times the volume, exactly.
inline exact::Dyadic volume_of(const TetMesh& mesh, std::span<const TetMesh::Corners> tets) {
  exact::Dyadic sum;
  for (const auto& c : tets)
    sum += exact::determinant(mesh.exact_position(c[0]), mesh.exact_position(c[1]), mesh.exact_position(c[2]),
                              mesh.exact_position(c[3]));
  return sum;
}

inline exact::Dyadic volume_of(const TetMesh& mesh) {
  std::vector<TetMesh::Corners> tets;
  for (const Tet t : living(mesh))
    if (!mesh.is_ghost(t)) tets.push_back(mesh.corners(t));
  return volume_of(mesh, tets);
}

// Where a point went, as exact coordinates.
inline exact::ExactPoint exact_of(const Position& position) {
  if (const auto* p = std::get_if<Point>(&position)) return exact::lift(p->data());
  return std::get<exact::ExactPoint>(position);
}

inline bool holds(const Kernel& kernel, const Position& position) {
  const exact::ExactPoint p = exact_of(position);
  const Point approx{p.c[0].to_double(), p.c[1].to_double(), p.c[2].to_double()};
  return kernel.holds({approx.data(), &p});
}

// Faces and edges with a constraint bit on any of their tetrahedra.
inline std::set<FaceKey> facet_faces(const TetMesh& mesh) {
  std::set<FaceKey> faces;
  for (const Tet t : living(mesh))
    for (int i = 0; i < 4; ++i)
      if (mesh.is_facet(face_code(t, i))) faces.insert(sorted(mesh.face_vertices(face_code(t, i))));
  return faces;
}

inline std::set<EdgeEnds> segment_edges(const TetMesh& mesh) {
  std::set<EdgeEnds> edges;
  for (const Tet t : living(mesh))
    for (int k = 0; k < 6; ++k)
      if (mesh.is_segment(t, k)) {
        const auto& e = kEdgeVertex[static_cast<std::size_t>(k)];
        edges.insert(sorted(EdgeEnds{mesh.corner(t, e[0]), mesh.corner(t, e[1])}));
      }
  return edges;
}

// The first place where two meshes differ, dead slots included, or an empty string.
inline std::string difference(const TetMesh& a, const TetMesh& b) {
  if (a.slot_count() != b.slot_count() || a.tet_count() != b.tet_count()) return "numbers of tetrahedra";
  if (a.vertex_count() != b.vertex_count() || a.exact_vertex_count() != b.exact_vertex_count())
    return "numbers of vertices";
  for (Tet t = 0; t < a.slot_count(); ++t) {
    if (a.corners(t) != b.corners(t) || a.flags(t) != b.flags(t)) return "tetrahedron " + std::to_string(t);
    for (int i = 0; i < 4; ++i)
      if (a.neighbour(t, i) != b.neighbour(t, i)) return "neighbours of tetrahedron " + std::to_string(t);
  }
  for (Vertex v = 0; v < a.vertex_count(); ++v)
    if (a.position(v) != b.position(v) || a.is_explicit(v) != b.is_explicit(v) ||
        a.exact_position(v).c != b.exact_position(v).c || a.incident(v) != b.incident(v))
      return "vertex " + std::to_string(v);
  return {};
}

}  // namespace holdfast::testing
