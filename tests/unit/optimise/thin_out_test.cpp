// Points that do not pay are removed: in which order, how many, and the effect on the rest.
#include "optimise/thin_out.h"

#include <gtest/gtest.h>

#include <random>

#include "delaunay/delaunay.h"
#include "mesh/editor.h"
#include "mesh/measure.h"
#include "mesh/validate.h"

namespace holdfast::thin_out_test {
namespace {

// Random points in the unit cube; the corners stay.
struct Cube {
  TetMesh mesh;
  std::vector<RegionId> region_of;
  std::vector<double> sizes;
  const std::vector<bool> kept{true};

  explicit Cube(int points, std::uint64_t seed = 1) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> any(0, 1);
    for (int k = 0; k < 8; ++k)
      MeshEditor(mesh).add_vertex(Point{double(k & 1), double((k >> 1) & 1), double(k >> 2)});
    for (int k = 0; k < points; ++k)
      MeshEditor(mesh).add_vertex(Point{any(random), any(random), any(random)});
    EXPECT_TRUE(build_delaunay(mesh, {1}, nullptr));
    region_of.assign(mesh.slot_count(), 0);
    sizes.assign(mesh.vertex_count(), 1);
  }
  [[nodiscard]] VolumeData data() { return {mesh, region_of, sizes, kept, 8}; }
};

struct Found {
  double weight = 0, worst = 0, volume = 0;
};

Found found(const ImprovedVolume& volume) {
  const TetMesh& mesh = volume.mesh();
  const SmallAngles small(volume);
  Found sum;
  for (Tet t = 0; t < mesh.slot_count(); ++t) {
    if (!volume.is_inside(t)) continue;
    sum.weight += small.weight(volume.energy(t));
    sum.worst = std::max(sum.worst, volume.energy(t));
    sum.volume += six_volumes(mesh, mesh.corners(t));
  }
  return sum;
}

constexpr double kAnyCost = 1e9;

TEST(Thinner, EndsAtTheGivenNumberOfTetrahedra) {
  Cube cube(300);
  ImprovedVolume volume(cube.data());
  Thinner thinner(volume, {}, [] {});
  const auto tets = static_cast<double>(cube.mesh.tet_count());
  EXPECT_EQ(thinner.run(tets, kAnyCost), 0u);
  const double half = thinner.tets_where_left(0.5);
  EXPECT_LT(half, 0.55 * tets);
  EXPECT_GT(half, 0.5 * tets);  // the ghosts stay
  EXPECT_GT(thinner.run(half, kAnyCost), 10u);
  EXPECT_LE(static_cast<double>(cube.mesh.tet_count()), half);
  EXPECT_GT(static_cast<double>(cube.mesh.tet_count()), 0.9 * half);
  EXPECT_EQ(find_fault(cube.mesh), "");
}

// The volume stays full, and no element becomes worse than the worst was.
TEST(Thinner, LeavesAValidMesh) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Cube cube(200, seed);
    ImprovedVolume volume(cube.data());
    const Found before = found(volume);
    EXPECT_GT(Thinner(volume, {}, [] {}).run(0, kAnyCost), 20u);
    const Found after = found(volume);
    EXPECT_EQ(find_fault(cube.mesh), "");
    EXPECT_NEAR(after.volume, before.volume, 1e-12);
    EXPECT_LE(after.worst, before.worst);
  }
}

// A removal at a cost of -1 reduces the weight by more than the number of removed tetrahedra.
TEST(Thinner, RemovesNoVertexThatCostsTooMuch) {
  Cube cube(300);
  ImprovedVolume volume(cube.data());
  const Found before = found(volume);
  const auto tets = static_cast<double>(cube.mesh.tet_count());
  Thinner thinner(volume, {}, [] {});
  const std::size_t gone = thinner.run(0, -1);
  EXPECT_GT(gone, 0u);
  const double fewer = tets - static_cast<double>(cube.mesh.tet_count());
  const double energies_at_most = tuning::kWeightOfTwiceTheEnergy * 100 * static_cast<double>(gone);
  EXPECT_LT(found(volume).weight, before.weight - fewer + energies_at_most);
  EXPECT_EQ(thinner.run(0, -1), 0u);  // nothing is left
  Cube same(300);
  ImprovedVolume of_same(same.data());
  EXPECT_GT(Thinner(of_same, {}, [] {}).run(0, kAnyCost), gone);
}

TEST(Thinner, LeavesVerticesThatAreNotFresh) {
  Cube cube(200);
  ImprovedVolume volume(cube.data());
  std::vector<std::uint8_t> fresh(150, 0);
  for (Vertex v = 100; v < 150; ++v) fresh[v] = 1;
  Thinner thinner(volume, fresh, [] {});
  const double all = Thinner(volume, {}, [] {}).tets_where_left(0.5);
  EXPECT_GT(thinner.tets_where_left(0.5), all);
  EXPECT_GT(thinner.run(0, kAnyCost), 10u);
  for (Vertex v = 0; v < 100; ++v) EXPECT_TRUE(cube.mesh.in_mesh(v));
}

TEST(Thinner, KeepsFigures) {
  Cube cube(200, 3);
  ImprovedVolume volume(cube.data());
  const Figures before = figures_of(cube.data());
  volume.keep(before);
  EXPECT_GT(Thinner(volume, {}, [] {}).run(0, kAnyCost), 0u);
  EXPECT_TRUE(figures_of(cube.data()).is_no_worse_than(before));
}

double longest_edge_inside(const TetMesh& mesh, Vertex first_free) {
  double most = 0;
  for (Tet t = 0; t < mesh.slot_count(); ++t) {
    if (!mesh.alive(t) || mesh.is_ghost(t)) continue;
    for (const Vertex v : mesh.corners(t))
      for (const Vertex w : mesh.corners(t))
        if (v >= first_free) most = std::max(most, distance(mesh.position(v), mesh.position(w)));
  }
  return most;
}

// Edges that were longer already may be as long again.
TEST(Thinner, RespectsTheSizesThatTheUserAllows) {
  constexpr double kSize = 0.3;
  Cube free(300), limited(300);
  free.sizes.assign(free.sizes.size(), 0.1);
  limited.sizes = free.sizes;
  const double most = std::max(2 * kSize, longest_edge_inside(limited.mesh, 8));
  ImprovedVolume any(free.data());
  Thinner(any, {}, [] {}).run(0, kAnyCost);
  const std::vector<double> limits{kSize};
  VolumeData data = limited.data();
  data.most_sizes = &limits;
  ImprovedVolume volume(data);
  EXPECT_GT(Thinner(volume, {}, [] {}).run(0, kAnyCost), 20u);
  EXPECT_LE(longest_edge_inside(limited.mesh, 8), most);
  EXPECT_GT(limited.mesh.tet_count(), 2 * free.mesh.tet_count());
}

// One to four at a time, in space and in a metric; the last one is inverted, so not positive.
TEST(ImprovedVolume, EnergiesOfSeveralAreThoseOfEach) {
  for (const bool in_metric : {false, true}) {
    Cube cube(50);
    std::vector<Metric> metrics(cube.mesh.vertex_count(), isotropic_metric(0.5));
    VolumeData data = cube.data();
    if (in_metric) data.metrics = &metrics;
    const ImprovedVolume volume(data);
    std::vector<TetMesh::Corners> all;
    for (Tet t = 0; t < cube.mesh.slot_count(); ++t)
      if (volume.is_inside(t)) all.push_back(cube.mesh.corners(t));
    std::swap(all.back()[0], all.back()[1]);
    for (std::size_t k = 0; k + 4 <= all.size(); ++k)
      for (std::size_t count = 1; count <= 4; ++count) {
        const std::array<double, 4> energies = volume.energies_of({&all[k], count});
        for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(energies[i], volume.energy_of(all[k + i]));
      }
    EXPECT_EQ(volume.energy_of(all.back()), kNoEnergy);
  }
}

TEST(Thinner, PollsWhileItRuns) {
  Cube cube(100);
  ImprovedVolume volume(cube.data());
  struct Enough {};
  int asked = 0;
  Thinner thinner(volume, {}, [&] {
    if (++asked == 50) throw Enough{};
  });
  EXPECT_THROW(thinner.run(0, kAnyCost), Enough);
  EXPECT_EQ(find_fault(cube.mesh), "");
}

}  // namespace
}  // namespace holdfast::thin_out_test
