// A mesh that is no longer Delaunay after recovery becomes Delaunay again, as far as constraints allow.
#include "refine/restore_delaunay.h"

#include <gtest/gtest.h>

#include <random>

#include "delaunay_checks.h"
#include "mesh/validate.h"
#include "mesh_fixtures.h"

namespace holdfast::restore_delaunay_test {
namespace {

using testing::delaunay_in_box;
using testing::random_points;

struct Volume {
  TetMesh mesh;
  std::vector<RegionId> region_of;
  std::vector<double> sizes;
  const std::vector<bool> kept{true, false};

  explicit Volume(TetMesh made)
      : mesh(std::move(made)), region_of(mesh.slot_count(), 0), sizes(mesh.vertex_count(), 1) {}
  std::size_t restore() {
    region_of.resize(mesh.slot_count(), 0);
    const Options options;
    Monitor monitor(options);
    return restore_delaunay({mesh, region_of, sizes, kept, 0}, Threads(1), monitor);
  }
};

std::size_t bad_faces(const TetMesh& mesh) {
  std::size_t count = 0;
  for (const Tet t : testing::living(mesh))
    if (!testing::local_fault(mesh, t).empty()) ++count;
  return count;
}

bool can_swap(const TetMesh& mesh, Face f) {
  if (mesh.is_facet(f) || mesh.is_ghost(tet_of(f)) || mesh.is_ghost(tet_of(mesh.neighbour(f)))) return false;
  const auto v = mesh.face_vertices(f);
  const Vertex top = mesh.apex(f), bottom = mesh.apex(mesh.neighbour(f));
  for (std::size_t k = 0; k < 3; ++k)
    if (mesh.orient(bottom, v[k], v[(k + 1) % 3], top) <= 0) return false;
  return true;
}

// Swaps some faces at random, as recovery does on the way to an edge.
std::size_t disturb(TetMesh& mesh, std::size_t swaps, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::size_t done = 0;
  for (int k = 0; k < 100'000 && done < swaps; ++k) {
    const auto f = static_cast<Face>(random() % (4 * mesh.slot_count()));
    if (!mesh.alive(tet_of(f)) || !can_swap(mesh, f)) continue;
    MeshEditor(mesh).swap_face(f);
    ++done;
  }
  return done;
}

TEST(RestoreDelaunay, UndoesFlips) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    TetMesh mesh = delaunay_in_box(random_points(200, seed));
    ASSERT_EQ(disturb(mesh, 40, seed), 40u);
    ASSERT_GT(bad_faces(mesh), 0u);
    Volume volume(std::move(mesh));
    EXPECT_GT(volume.restore(), 0u);
    EXPECT_EQ(bad_faces(volume.mesh), 0u) << "seed " << seed;
    EXPECT_EQ(find_fault(volume.mesh), "");
  }
}

TEST(RestoreDelaunay, DoesNotChangeADelaunayMesh) {
  Volume volume(delaunay_in_box(random_points(200, 5)));
  EXPECT_EQ(volume.restore(), 0u);
}

TEST(RestoreDelaunay, KeepsConstraintsAndOtherRegions) {
  TetMesh mesh = delaunay_in_box(random_points(200, 3));
  ASSERT_EQ(disturb(mesh, 40, 3), 40u);
  std::vector<std::array<Vertex, 3>> facets;
  for (const Tet t : testing::living(mesh)) {
    if (mesh.is_ghost(t) || testing::local_fault(mesh, t).empty() || facets.size() == 10) continue;
    const auto v = mesh.face_vertices(face_code(t, 0));
    MeshEditor(mesh).set_facet(face_code(t, 0));
    for (std::size_t k = 0; k < 3; ++k) MeshEditor(mesh).set_segment(t, v[k], v[(k + 1) % 3]);
    facets.push_back(v);
  }
  Volume volume(std::move(mesh));
  volume.restore();
  EXPECT_EQ(find_fault(volume.mesh), "");
  for (const auto& [a, b, c] : facets) {
    const Face f = find_face(volume.mesh, a, b, c);
    ASSERT_NE(f, kNone);
    EXPECT_TRUE(volume.mesh.is_facet(f));
  }

  Volume other(delaunay_in_box(random_points(200, 3)));
  ASSERT_EQ(disturb(other.mesh, 40, 3), 40u);
  other.region_of.assign(other.mesh.slot_count(), 1);
  EXPECT_EQ(other.restore(), 0u);
}

}  // namespace
}  // namespace holdfast::restore_delaunay_test
