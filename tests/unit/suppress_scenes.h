// Polyhedra, and meshes with constraints and Steiner points, for tests of suppression.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "enforce/enforce.h"
#include "mesh/assembly.h"
#include "mesh/validate.h"
#include "mesh_fixtures.h"

namespace holdfast::testing {

using Random = std::mt19937_64;
using Faces = std::vector<FaceKey>;

const double kMostTwist = std::acos(-1.0) / 3;

struct Polyhedron {
  TetMesh mesh;  // only vertices
  Faces faces;   // seen positively from inside
};

// Schönhardt's: two triangles and three quadrilaterals, bent inwards along their diagonals if twist > 0.
inline Polyhedron twisted_prism(double twist, double height) {
  Polyhedron prism;
  for (int k = 0; k < 6; ++k) {
    const double angle = 2 * kMostTwist * (k % 3) + (k < 3 ? 0 : twist);
    MeshEditor(prism.mesh).add_vertex(Point{std::cos(angle), std::sin(angle), k < 3 ? 0 : height});
  }
  prism.faces = {{0, 1, 2}, {3, 5, 4}};
  for (Vertex k = 0; k < 3; ++k) {
    const Vertex j = (k + 1) % 3;
    prism.faces.insert(prism.faces.end(), {{k, 3 + j, j}, {k, 3 + k, 3 + j}});
  }
  return prism;
}

inline FaceKey rotated(FaceKey f) {
  std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
  return f;
}

// Faces that remain after those with equal corners and opposite orientations have cancelled.
inline std::set<FaceKey> boundary_of(const std::vector<TetMesh::Corners>& tets) {
  std::set<FaceKey> open;
  for (const auto& c : tets)
    for (const auto& k : kFaceVertex) {
      const FaceKey f{c[static_cast<std::size_t>(k[0])], c[static_cast<std::size_t>(k[1])],
                      c[static_cast<std::size_t>(k[2])]};
      if (open.erase(rotated({f[0], f[2], f[1]})) == 0) open.insert(rotated(f));
    }
  return open;
}

inline std::set<FaceKey> as_set(const Faces& faces) {
  std::set<FaceKey> out;
  for (const FaceKey& f : faces) out.insert(rotated(f));
  return out;
}

inline exact::Dyadic volume_of(const Polyhedron& p) { return testing::volume_of(p.mesh, cone(p.faces, 0)); }

// Input points and a box, constraints between them, and Steiner points off every constraint.
struct Scene {
  TetMesh mesh;
  Vertex first_free = 0;
  std::set<FaceKey> facets;
  std::set<EdgeEnds> segments;
  exact::Dyadic volume;

  [[nodiscard]] std::vector<Vertex> steiner() const {
    std::vector<Vertex> out;
    for (Vertex v = first_free; v < mesh.vertex_count(); ++v)
      if (mesh.in_mesh(v)) out.push_back(v);
    return out;
  }
  inline void remember() {
    facets = facet_faces(mesh);
    segments = segment_edges(mesh);
    volume = testing::volume_of(mesh);
  }
  void expect_kept() const {
    ASSERT_EQ(find_fault(mesh), "");
    ASSERT_EQ(facet_faces(mesh), facets);
    ASSERT_EQ(segment_edges(mesh), segments);
    ASSERT_EQ(testing::volume_of(mesh), volume);
    const std::vector<Vertex> points = steiner();
    ASSERT_EQ(std::count_if(points.begin(), points.end(), [&](Vertex p) { return !mesh.is_explicit(p); }),
              static_cast<std::ptrdiff_t>(mesh.exact_vertex_count()));
  }
};

inline void constrain(TetMesh& mesh, Tet t, int face) {
  const auto [a, b, c] = mesh.face_vertices(face_code(t, face));
  MeshEditor(mesh).set_facet(face_code(t, face));
  for (const auto& e : {EdgeEnds{a, b}, EdgeEnds{b, c}, EdgeEnds{c, a}})
    MeshEditor(mesh).set_segment(t, e[0], e[1]);
}

inline Scene scene(std::size_t input, std::size_t steiner, double share_of_facets, std::uint64_t seed) {
  Scene s;
  std::vector<Point> points = random_points(input, seed);
  for (int k = 0; k < 8; ++k) points.push_back({k & 1 ? 3. : -3., k & 2 ? 3. : -3., k & 4 ? 3. : -3.});
  for (const Point& p : points) MeshEditor(s.mesh).add_vertex(p);
  s.first_free = static_cast<Vertex>(points.size());
  for (const Point& p : random_points(steiner, seed + 1000)) MeshEditor(s.mesh).add_vertex(p);
  EXPECT_TRUE(build_delaunay(s.mesh, {}, nullptr));
  Random random(seed);
  std::bernoulli_distribution chosen(share_of_facets), dangling(0.02);
  for (const Tet t : living(s.mesh)) {
    if (s.mesh.is_ghost(t)) continue;
    for (int i = 0; i < 4; ++i) {
      const auto [a, b, c] = s.mesh.face_vertices(face_code(t, i));
      if (std::max({a, b, c}) < s.first_free && chosen(random)) constrain(s.mesh, t, i);
      if (std::max(a, b) < s.first_free && dangling(random)) MeshEditor(s.mesh).set_segment(t, a, b);
    }
  }
  s.remember();
  return s;
}

}  // namespace holdfast::testing
