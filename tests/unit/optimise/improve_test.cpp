// The parts that improve the elements of a field mesh: energies, shapes, cavities of points, the improvement
// of a volume.
#include "optimise/improve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "delaunay/delaunay.h"
#include "mesh/editor.h"
#include "mesh/measure.h"
#include "mesh/quality.h"
#include "mesh/validate.h"
#include "optimise/add_point.h"
#include "optimise/energy.h"
#include "optimise/refill.h"
#include "optimise/shape.h"
#include "refine/order.h"
#include "refine/point_cavity.h"

namespace holdfast::improve_test {
namespace {

TEST(Energy, IsOfTheLeastAngle) {
  const Point a{0, 0, 0}, b{1, 0, 0}, c{0.5, std::sqrt(0.75), 0},
      d{0.5, std::sqrt(1.0 / 12), std::sqrt(2.0 / 3)};
  EXPECT_NEAR(energy(a, b, c, d), energy_of_sine(std::sin(std::acos(1.0 / 3))), 1e-9);
  EXPECT_EQ(energy(a, b, c, c), kNoEnergy);
  EXPECT_EQ(energy(a, c, b, d), kNoEnergy);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int k = 0; k < 1000; ++k) {
    std::array<Point, 4> p;
    for (Point& x : p)
      for (double& y : x) y = any(random);
    const double e = energy(p[0], p[1], p[2], p[3]);
    if (e == kNoEnergy) continue;
    double least = 2;
    for (const double angle : dihedral_angles(p[0], p[1], p[2], p[3])) {
      const double sine = std::sin(angle * 3.14159265358979 / 180);
      least = std::min(least, angle > 90 ? sine * std::sqrt(1.5) : sine);
    }
    EXPECT_NEAR(e / energy_of_sine(least), 1, 1e-5);
    const EnergyRule early{.hopeless_sine = 0.4};
    EXPECT_NEAR(energy<double>(p[0], p[1], p[2], p[3], early) / energy_of_sine(least, early), 1, 1e-5);
    const EnergyRule bounded{.hopeless_sine = 0.4, .saturation = 0.1};
    EXPECT_NEAR(energy<double>(p[0], p[1], p[2], p[3], bounded) / energy_of_sine(least, bounded), 1, 1e-5);
  }
}

// Hopeless elements count for less than by the usual rule, relative to others; the others count the same.
TEST(Energy, GrowsLessBelowTheHopelessSine) {
  const EnergyRule early{.hopeless_sine = 0.4};
  EXPECT_EQ(energy_of_sine(0.5, early), energy_of_sine(0.5));
  EXPECT_NEAR(energy_of_sine(0.2, early) / energy_of_sine(0.4, early), 4, 1e-12);
  EXPECT_NEAR(energy_of_sine(0.2) / energy_of_sine(0.4), 16, 1e-12);
}

// The energy still tells which of two hopeless elements is worse.
TEST(Energy, IsBoundedForHopelessElementsIfSaturated) {
  const EnergyRule bounded{.hopeless_sine = 0.4, .saturation = 0.1};
  EXPECT_EQ(energy_of_sine(0.5, bounded), energy_of_sine(0.5));
  EXPECT_NEAR(energy_of_sine(0.4 - 1e-12, bounded) / energy_of_sine(0.4), 1, 1e-9);
  EXPECT_NEAR(energy_of_sine(0, bounded) / energy_of_sine(0.4), 11, 1e-9);
  EXPECT_GT(energy_of_sine(0.01, bounded), energy_of_sine(0.02, bounded));
}

TEST(Shape, ANeedleIsNotFlat) {
  const double h = std::sqrt(0.75);
  const Point a{0, 0, 0}, b{1, 0, 0}, c{0.5, h, 0};
  const auto apex = [&](double height) { return Point{0.5, h / 3, height}; };
  EXPECT_GT(quality(a, b, c, apex(100)), 30);
  EXPECT_FALSE(is_flat(a, b, c, apex(100)));
  EXPECT_FALSE(is_flat(a, b, c, apex(0.8)));
  EXPECT_TRUE(is_flat(a, b, c, apex(0.005)));                                      // a cap
  EXPECT_TRUE(is_flat({0, 0, 0}, {1, 0, 0.01}, {1, 1, 0}, {0, 1, 0.01}));          // a sliver
  EXPECT_FALSE(is_flat({0, 0, 0}, {1, 0, 0}, {0, 0.01, 0.01}, {0, -0.01, 0.02}));  // a splinter
}

/// The Delaunay triangulation of random points in the unit cube and the corners of a cube around it, `margin`
/// away. It has many slivers.
TetMesh random_mesh(int points, std::uint64_t seed, double margin = 0) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> any(0, 1);
  TetMesh mesh;
  const auto side = [&](bool high) { return high ? 1 + margin : -margin; };
  for (int k = 0; k < 8; ++k)
    MeshEditor(mesh).add_vertex(Point{side((k & 1) != 0), side((k & 2) != 0), side((k & 4) != 0)});
  for (int k = 0; k < points; ++k) MeshEditor(mesh).add_vertex(Point{any(random), any(random), any(random)});
  EXPECT_TRUE(build_delaunay(mesh, {1}, nullptr));
  return mesh;
}

Tet any_solid(const TetMesh& mesh) {
  Tet t = 0;
  while (!mesh.alive(t) || mesh.is_ghost(t)) ++t;
  return t;
}

TEST(PointCavity, InsertsPointAfterPointAndKeepsTheMeshValid) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(0, 1);
  TetMesh mesh = random_mesh(0, 3, 0.5);
  PointCavity cavity(mesh);
  for (int k = 0; k < 300; ++k) {
    const Vertex p = MeshEditor(mesh).add_vertex(Point{any(random), any(random), any(random)});
    const Tet base = cavity.locate(p, any_solid(mesh));
    ASSERT_NE(base, kNone);
    ASSERT_TRUE(cavity.find(p, base, {}));
    if (k % 3 == 0) {
      cavity.abandon();
      MeshEditor(mesh).remove_last_vertex();
    } else {
      cavity.insert();
    }
  }
  EXPECT_EQ(find_fault(mesh), "");
}

TEST(Energy, OfTwoAtOnceIsThatOfEach) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int k = 0; k < 100; ++k) {
    std::array<std::array<Point, 4>, 2> p;
    std::array<PointOf<Pair>, 4> both;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t lane = 0; lane < 2; ++lane) both[i][j][lane] = p[lane][i][j] = any(random);
    const Pair e = energy<Pair>(both[0], both[1], both[2], both[3]);
    for (std::size_t lane = 0; lane < 2; ++lane)
      EXPECT_EQ(e[lane], energy(p[lane][0], p[lane][1], p[lane][2], p[lane][3]));
  }
}

HOLDFAST_WITH_FOURS void expect_four_to_be_those_of_each(std::mt19937_64& random) {
  std::uniform_real_distribution<double> any(-1, 1);
  std::array<std::array<Point, 4>, 4> p;
  std::array<PointOf<Four>, 4> all;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t lane = 0; lane < 4; ++lane) all[i][j][lane] = p[lane][i][j] = any(random);
  Four e{};
  put_energy<Four>(all[0], all[1], all[2], all[3], EnergyRule{}, e);
  for (std::size_t lane = 0; lane < 4; ++lane) {
    const double of_lane = e[lane];
    EXPECT_EQ(of_lane, energy(p[lane][0], p[lane][1], p[lane][2], p[lane][3]));
  }
}

TEST(Energy, OfFourAtOnceIsThatOfEach) {
  if (!has_fours()) GTEST_SKIP() << "the processor has no four at once";
  std::mt19937_64 random(3);
  for (int k = 0; k < 100; ++k) expect_four_to_be_those_of_each(random);
}

TEST(Improve, LeavesAValidMeshWithBetterElements) {
  TetMesh mesh = random_mesh(2000, 5);
  std::vector<RegionId> region_of(mesh.slot_count(), 0);
  const std::vector<bool> kept{true};
  std::vector<double> sizes(mesh.vertex_count(), 0.1);
  const VolumeData volume{mesh, region_of, sizes, kept, 8};
  order_along_curve(volume);
  ASSERT_EQ(find_fault(mesh), "");
  const auto below_10 = [&] {
    const ShapeCounts shape = shape_of(volume);
    return shape.least_dihedral[0] + shape.least_dihedral[1];
  };
  const std::size_t before = below_10();
  const Options options;
  Monitor monitor(options);
  const ImproveStats stats = improve(volume, Effort::good, monitor);
  EXPECT_EQ(find_fault(mesh), "");
  EXPECT_GT(stats.moved, 0u);
  EXPECT_GT(stats.swapped, 0u);
  EXPECT_LT(4 * below_10(), before);
}

/// What `act` does to a mesh of slivers with all vertices fixed, so that bad elements stay.
template <class Act>
auto of_standing_slivers(int points, Act&& act) {
  TetMesh mesh = random_mesh(points, 5);
  std::vector<RegionId> region_of(mesh.slot_count(), 0);
  std::vector<double> sizes(mesh.vertex_count(), 0.1);
  const std::vector<bool> kept{true};
  const VolumeData volume{mesh, region_of, sizes, kept, static_cast<Vertex>(mesh.vertex_count())};
  const Options options;
  Monitor monitor(options);
  auto result = act(volume, monitor);
  EXPECT_EQ(find_fault(mesh), "");
  return result;
}

// How many slivers are left in a mesh decides whether a comparison is worthwhile.
TEST(Improve, IsBriefWhereManyElementsAreBadAndOnlyIfItMay) {
  const auto improved = [](bool may_be_brief) {
    return of_standing_slivers(2000, [&](const VolumeData& volume, Monitor& monitor) {
      return improve(volume, {Effort::fast, may_be_brief}, monitor);
    });
  };
  const ImproveStats whole = improved(false), brief = improved(true);
  EXPECT_FALSE(whole.was_brief);
  EXPECT_TRUE(brief.was_brief);
  EXPECT_LT(brief.inserted, whole.inserted);
}

struct Thinned {
  ImproveStats stats;
  double tets = 0;
};

// Half of the vertices of a random mesh are free.
Thinned thinned(const Extent& extent) {
  TetMesh mesh = random_mesh(2000, 5);
  std::vector<RegionId> region_of(mesh.slot_count(), 0);
  const std::vector<bool> kept{true};
  std::vector<double> sizes(mesh.vertex_count(), 1);
  const VolumeData volume{mesh, region_of, sizes, kept, 1000};
  const Options options;
  Monitor monitor(options);
  const ImproveStats stats = improve(volume, extent, monitor);
  EXPECT_EQ(find_fault(mesh), "");
  return {stats, static_cast<double>(mesh.tet_count())};
}

// If facets force much, so that the pass is brief, points are removed again: the free ones.
TEST(Improve, ThinsOutWhatIsBrief) {
  const auto tets_left = [](double least_part) {
    Extent extent{Effort::fast, true};
    extent.least_part = least_part;
    const Thinned made = thinned(extent);
    EXPECT_TRUE(made.stats.was_brief);
    EXPECT_FALSE(made.stats.was_thinned);
    return made.tets;
  };
  EXPECT_LT(tets_left(0.5), 0.95 * tets_left(1));
}

// If it is not brief, points are removed in the end, as many as the allowed cost permits, if much is bad.
TEST(Improve, ThinsOutInTheEndWhereMuchIsBad) {
  const auto made = [](double part_of_bad, double most_cost) {
    Extent extent = Effort::fast;
    extent.least_part = 0.5;
    extent.part_of_bad = part_of_bad;
    extent.most_cost = most_cost;
    return thinned(extent);
  };
  const Thinned much_is_bad = made(0.01, 0.1), little_is_bad = made(0.9, 0.1);
  EXPECT_TRUE(much_is_bad.stats.was_thinned);
  EXPECT_FALSE(little_is_bad.stats.was_thinned);
  EXPECT_LT(much_is_bad.tets, 0.95 * little_is_bad.tets);
  EXPECT_LT(made(0.01, 0.5).tets, much_is_bad.tets);
}

// Unlimited points are added without end if all vertices are fixed.
TEST(Improve, AddsNoPointsBeyondTheGrowthThatIsAllowed) {
  const auto improved = [](double most_growth) {
    return of_standing_slivers(1000, [&](const VolumeData& volume, Monitor& monitor) {
      Extent extent = Effort::good;
      extent.lowers_shares = true;
      extent.most_growth = most_growth;
      const auto before = static_cast<double>(volume.mesh.tet_count());
      const ImproveStats stats = improve_further(volume, extent, figures_of(volume), {0, 1}, monitor);
      return std::pair(stats.inserted, static_cast<double>(volume.mesh.tet_count()) / before);
    });
  };
  const auto [some, little] = improved(0.01);
  const auto [many, much] = improved(0.5);
  EXPECT_EQ(improved(-0.9).first, 0u);
  EXPECT_GT(some, 0u);
  EXPECT_GT(many, some);
  EXPECT_GT(much, 1.02);
  EXPECT_LT(little, much);
}

// The same for the first work on a volume.
TEST(Improve, BeginsWithNoPointsBeyondTheGrowthThatIsAllowed) {
  const auto inserted = [](double most_growth) {
    return of_standing_slivers(1000, [&](const VolumeData& volume, Monitor& monitor) {
      Extent extent = Effort::fast;
      extent.most_growth = most_growth;
      return improve(volume, extent, monitor).inserted;
    });
  };
  EXPECT_EQ(inserted(-0.9), 0u);
  EXPECT_GT(inserted(1), 0u);
}

// Over all elements: their number below 10, 20 and 30 degrees, weighted, over what elements may weigh; and
// the same by volume.
std::array<double, 2> burden_of(const TetMesh& mesh, const ImprovedVolume& volume) {
  std::array<double, 2> sum{};
  for (Tet t = 0; t < mesh.slot_count(); ++t) {
    if (!volume.is_inside(t)) continue;
    const double e = volume.energy(t);
    const double weight = (e > energy_of_sine(0.1736)) + (e > energy_of_sine(0.342)) + (e > 16);
    sum[0] += weight - 0.5;
    sum[1] += weight * six_volumes(mesh, mesh.corners(t));
  }
  return sum;
}

TEST(ImprovedVolume, IsJudgedByAnotherSineFromThenOn) {
  TetMesh mesh = random_mesh(100, 3);
  std::vector<RegionId> region_of(mesh.slot_count(), 0);
  const std::vector<bool> kept{true};
  std::vector<double> sizes(mesh.vertex_count(), 1);
  const VolumeData data{mesh, region_of, sizes, kept, 8};
  const ImprovedVolume usual(data), early(data, {}, 1, 0.4);
  ImprovedVolume volume(data, {}, 1, 0.4);
  std::size_t less = 0;
  for (Tet t = 0; t < mesh.slot_count(); ++t) {
    EXPECT_EQ(volume.energy(t), early.energy(t));
    if (early.energy(t) < usual.energy(t)) ++less;
  }
  EXPECT_GT(less, 10u);
  ImprovedVolume bounded(data, {}, 1, tuning::kHopelessSine, 0.1);
  EXPECT_LT(bounded.energy_of_sine(0.1), energy_of_sine(0.1));
  bounded.judge_by(tuning::kHopelessSine);
  volume.judge_by(tuning::kHopelessSine);
  EXPECT_EQ(volume.energy_of_sine(0.1), energy_of_sine(0.1));
  for (Tet t = 0; t < mesh.slot_count(); ++t) {
    EXPECT_EQ(volume.energy(t), usual.energy(t));
    EXPECT_EQ(bounded.energy(t), usual.energy(t));
    if (volume.is_inside(t)) {
      EXPECT_EQ(volume.energy_of(mesh.corners(t)), usual.energy(t));
    }
  }
}

TEST(PointAdder, LowersSharesOfSmallAnglesWhereItMust) {
  for (const bool must : {false, true}) {
    TetMesh mesh = random_mesh(300, 7);
    std::vector<RegionId> region_of(mesh.slot_count(), 0);
    const std::vector<bool> kept{true};
    std::vector<double> sizes(mesh.vertex_count(), 1);
    ImprovedVolume volume({mesh, region_of, sizes, kept, 8});
    PointAdder adder(volume);
    adder.must_pay(must);
    std::size_t added = 0, dear = 0;
    const std::size_t slots = mesh.slot_count();
    for (Tet t = 0; t < slots; ++t) {
      if (!volume.is_inside(t) || volume.energy(t) < energy_of_sine(0.42)) continue;
      const std::array<double, 2> before = burden_of(mesh, volume);
      if (!adder.add(t, false)) continue;
      ++added;
      const std::array<double, 2> after = burden_of(mesh, volume);
      if (after[0] > before[0] && after[1] > before[1]) ++dear;
    }
    EXPECT_GT(added, 10u);
    EXPECT_EQ(find_fault(mesh), "");
    if (must)
      EXPECT_EQ(dear, 0u);
    else
      EXPECT_GT(dear, 0u);
  }
}

TEST(CavityRefiller, LessensTheEnergyAndLeavesAValidMesh) {
  TetMesh mesh = random_mesh(200, 6);
  std::vector<RegionId> region_of(mesh.slot_count(), 0);
  const std::vector<bool> kept{true};
  std::vector<double> sizes(mesh.vertex_count(), 1);
  ImprovedVolume volume({mesh, region_of, sizes, kept, 8});
  const auto total = [&] {
    double sum = 0;
    for (Tet t = 0; t < mesh.slot_count(); ++t)
      if (volume.is_inside(t)) sum += volume.energy(t);
    return sum;
  };
  CavityRefiller refiller(volume);
  double energy = total();
  std::size_t refilled = 0, with_point = 0;
  for (Tet t = 0; t < mesh.slot_count(); ++t) {
    if (!volume.is_inside(t) || volume.energy(t) < energy_of_sine(0.2)) continue;
    if (refiller.refill(t).empty()) continue;
    ++refilled;
    if (refiller.point() != kNone) ++with_point;
    ASSERT_LT(total(), energy);
    energy = total();
  }
  EXPECT_EQ(find_fault(mesh), "");
  EXPECT_GT(with_point, 0u);
  EXPECT_GT(refilled, with_point);
}

}  // namespace
}  // namespace holdfast::improve_test
