// Field points, through the public API: sizes, shapes, limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numeric>
#include <set>

#include "checked_mesh.h"
#include "hard_surfaces.h"
#include "holdfast/check.h"
#include "holdfast/holdfast.h"
#include "io_samples.h"
#include "small_surfaces.h"

namespace holdfast::field_test {
namespace {

using testing::mesh_with;

double mean_edge_in(const Volume& volume, const std::function<bool(const Point&)>& holds) {
  std::set<std::array<Index, 2>> edges;
  for (const Tetrahedron& t : volume.tetrahedra)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) edges.insert({std::min(t[i], t[j]), std::max(t[i], t[j])});
  double sum = 0;
  int count = 0;
  for (const auto& [a, b] : edges) {
    const Point &p = volume.vertices[a], &q = volume.vertices[b];
    if (!holds(p) || !holds(q)) continue;
    sum += std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
    ++count;
  }
  return count == 0 ? 0 : sum / count;
}

bool near_the_centre(const Point& p) { return std::hypot(p[0], p[1], p[2]) < 0.5; }

TEST(FieldPoints, WithoutSizesThereAreNone) {
  const Surface sphere = hard::icosphere(2);
  const Result result = mesh(sphere.view());
  EXPECT_EQ(result.report.field.points, 0u);
  EXPECT_EQ(result.report.steiner_points, 0u);
}

// A disc as thin as gilding: both faces are fans, each around one vertex of its rim.
Surface double_fan(Index n) {
  Surface fan;
  for (const double z : {0.0, 0.001})
    for (Index k = 0; k < n; ++k) {
      const double angle = 2 * 3.14159265358979 * k / n;
      fan.vertices.push_back({std::cos(angle), std::sin(angle), z});
    }
  for (Index k = 0; k < n; ++k) {
    const Index next = (k + 1) % n;
    fan.facets.push_back({k, next, n + next});
    fan.facets.push_back({k, n + next, n + k});
  }
  for (Index k = 1; k + 1 < n; ++k) {
    fan.facets.push_back({0, k + 1, k});
    fan.facets.push_back({n + n / 2, n + (n / 2 + k) % n, n + (n / 2 + k + 1) % n});
  }
  return fan;
}

// Each cavity between the fans has thousands of tetrahedra. This took 30 times as long as the flips, and now
// takes four times as long, or ten with sanitizers: in processor time, which other programs do not change.
TEST(FieldPoints, CavitiesOfThousandsAreNotTriedWithoutEnd) {
  std::map<Stage, std::clock_t> begun;
  Options options;
  options.effort = Effort::fast;
  options.progress = [&](const Progress& progress) {
    begun.try_emplace(progress.stage, std::clock());
    return true;
  };
  const Result result = mesh_with(double_fan(1000), {}, options);
  const auto between = [&](Stage first, Stage next) { return begun.at(next) - begun.at(first); };
  EXPECT_LT(between(Stage::field_points, Stage::optimise), 18 * between(Stage::flips, Stage::partition));
}

TEST(FieldPoints, SizeIsTheLengthOfEdges) {
  const Surface sphere = hard::icosphere(2);
  for (const double size : {0.2, 0.1}) {
    const Result result = mesh_with(sphere, {.size = size});
    EXPECT_NEAR(mean_edge_in(result.volume, near_the_centre) / size, 1.05, 0.15) << size;
  }
}

// A cylinder whose ends are fans of needles, each around one vertex of its rim.
Surface fanned_cylinder(Index n) {
  Surface cylinder = double_fan(n);
  for (Point& p : cylinder.vertices)
    if (p[2] > 0) p[2] = 2;
  return cylinder;
}

// Points used to come arbitrarily near to triangles much larger than the size, next to the tetrahedra on
// these: 5.5 % of the elements were below 10 degrees.
TEST(FieldPoints, TrianglesMuchLargerThanTheSizeKeepPointsAway) {
  Options options;
  options.effort = Effort::fast;
  const Result result = mesh_with(fanned_cylinder(48), {.size = 0.1}, options);
  const auto count = static_cast<double>(result.volume.tetrahedra.size());
  EXPECT_LT(static_cast<double>(result.report.field.below_10_deg), 0.035 * count);
  EXPECT_GT(count, 20'000);  // the size counts all the same
  EXPECT_NEAR(
      mean_edge_in(result.volume, [](const Point& p) { return std::hypot(p[0], p[1], p[2] - 1) < 0.4; }) /
          0.1,
      1.05, 0.15);
}

// Between large triangles two and a half sizes apart, the work of a round used to end before all elements
// inside had been tried: 6.6 % were below 10 degrees.
TEST(FieldPoints, WorkGoesOnWhileManyElementsInsideAreBad) {
  Surface plate = small::box();
  for (Point& p : plate.vertices) p[2] *= 0.1;
  const Result result = mesh_with(plate, {.size = 0.04});
  EXPECT_LT(static_cast<double>(result.report.field.below_10_deg),
            0.05 * static_cast<double>(result.volume.tetrahedra.size()));
}

// A plate: two triangles on one side, a grid of n squares a side on the other.
Surface half_fine_plate(Index n, double thickness) {
  Surface plate;
  for (Index i = 0; i <= n; ++i)
    for (Index j = 0; j <= n; ++j) plate.vertices.push_back({i / double(n), j / double(n), 0});
  const auto at = [n](Index i, Index j) { return i * (n + 1) + j; };
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      plate.facets.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      plate.facets.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  const auto top = static_cast<Index>(plate.vertices.size());
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
    plate.vertices.push_back({double(x), double(y), thickness});
  plate.facets.push_back({top, top + 1, top + 2});
  plate.facets.push_back({top, top + 2, top + 3});
  for (Index side = 0; side < 4; ++side) {
    const auto along = [&](Index k) {
      return std::array{at(k, 0), at(n, k), at(n - k, n), at(0, n - k)}[side];
    };
    for (Index k = 0; k < n; ++k) plate.facets.push_back({top + side, along(k), along(k + 1)});
    plate.facets.push_back({top + side, along(n), top + (side + 1) % 4});
  }
  return plate;
}

// From the size on that made the large triangles much larger than it, sizes used to grow next to the fine
// ones, too: 1,382 tetrahedra instead of 1,635 without a size.
TEST(FieldPoints, ASizeAskedForDoesNotMakeElementsLarger) {
  const Surface plate = half_fine_plate(16, 0.2);
  const auto count = [&](double size) {
    return static_cast<double>(mesh_with(plate, {.size = size}).volume.tetrahedra.size());
  };
  EXPECT_GT(count(0.14), 0.93 * count(9));
}

// A box a few sizes wide is near its large triangles everywhere. Regular tetrahedra with edges H would number
// 8.49 V / H^3.
TEST(FieldPoints, SmallBoxesGetTheNumberThatTheSizeAsksFor) {
  for (const double size : {0.05, 0.1, 0.15, 0.2}) {
    const Result result = mesh_with(small::box(), {.size = size});
    const double regular = 8.49 / (size * size * size);
    EXPECT_GE(static_cast<double>(result.volume.tetrahedra.size()), regular / 2) << size;
    EXPECT_LE(static_cast<double>(result.volume.tetrahedra.size()), regular) << size;
  }
}

TEST(FieldPoints, SizesGrowInwardUnlessToldNotTo) {
  const Surface sphere = hard::icosphere(3);
  const double grown = mean_edge_in(mesh_with(sphere, {}).volume, near_the_centre);
  const double steeper = mean_edge_in(mesh_with(sphere, {.gradation = 0.6}).volume, near_the_centre);
  const double level = mean_edge_in(mesh_with(sphere, {.grow = false}).volume, near_the_centre);
  EXPECT_GT(grown, 1.5 * level);
  EXPECT_GT(steeper, 1.1 * grown);
  EXPECT_NEAR(level, 0.19, 0.03);  // the surface has 0.145 to 0.165
}

Result sphere_with(Effort effort) {
  Options options;
  options.effort = effort;
  return mesh_with(hard::icosphere(4), {.grow = false}, options);
}

double share_below_30_deg(const Result& result) {
  const auto& least = result.report.field.after.least_dihedral;
  EXPECT_EQ(std::accumulate(least.begin(), least.end(), std::size_t{0}), result.volume.tetrahedra.size());
  const std::size_t below = std::accumulate(least.begin(), least.begin() + 6, std::size_t{0});
  return static_cast<double>(below) / static_cast<double>(result.volume.tetrahedra.size());
}

TEST(FieldPoints, TheVolumeOfASphereIsFitToComputeWith) {
  for (const Effort effort : {Effort::good, Effort::best}) {
    const Result result = sphere_with(effort);
    const Report::Field& field = result.report.field;
    EXPECT_GT(field.after.min_dihedral_deg, 20);
    EXPECT_LT(field.after.max_dihedral_deg, 155);
    EXPECT_GT(field.after.min_dihedral_deg, field.before.min_dihedral_deg);
    EXPECT_EQ(field.below_10_deg, 0u);
    EXPECT_LT(share_below_30_deg(result), 0.01);
  }
}

// Little work lowers the share of mild elements.
TEST(FieldPoints, DefaultEffortLeavesAThirdOfWhatFastLeavesBelow30Degrees) {
  EXPECT_LT(3 * share_below_30_deg(sphere_with(Effort::good)), share_below_30_deg(sphere_with(Effort::fast)));
}

TEST(FieldPoints, AFunctionOfTheUserIsAsked) {
  const Surface box = small::box();
  const Result result = mesh_with(box, {.field = [](const Point& p) { return p[0] < 0.5 ? 0.05 : 0.2; }});
  const double left = mean_edge_in(result.volume, [](const Point& p) {
    return p[0] > 0.15 && p[0] < 0.4 && p[1] > 0.3 && p[1] < 0.7 && p[2] > 0.3 && p[2] < 0.7;
  });
  const double right = mean_edge_in(result.volume, [](const Point& p) {
    return p[0] > 0.75 && p[0] < 1 && p[1] > 0.2 && p[1] < 0.8 && p[2] > 0.2 && p[2] < 0.8;
  });
  EXPECT_NEAR(left, 0.053, 0.01);
  EXPECT_GT(right, 2 * left);
}

TEST(FieldPoints, AFunctionOfManyPointsGivesTheSameMeshWithFewerCalls) {
  const Surface box = small::box();
  const auto size = [](const Point& p) { return p[0] < 0.5 ? 0.1 : 0.2; };
  std::size_t single = 0, calls = 0, points = 0;
  const Result one_by_one = mesh_with(box, {.field = [&](const Point& p) {
                                        ++single;
                                        return size(p);
                                      }});
  const auto sizes = [&](std::span<const Point> at, std::span<double> found) {
    ++calls;
    points += at.size();
    std::transform(at.begin(), at.end(), found.begin(), size);
  };
  const Result many = mesh_with(box, {.fields = sizes});
  EXPECT_EQ(one_by_one.volume.vertices, many.volume.vertices);
  EXPECT_EQ(one_by_one.volume.tetrahedra, many.volume.tetrahedra);
  EXPECT_EQ(points, single);
  EXPECT_LT(4 * calls, 3 * single);
}

TEST(FieldPoints, ARegionHasASizeOfItsOwn) {
  Surface surface = small::nested(true);
  Options options;
  options.keep = Keep::bounded;
  std::array<double, 3> low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
  for (const Point& p : surface.vertices)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  const Point centre{(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2};
  options.regions = {{centre, 7, 0.05 * (high[0] - low[0])}};
  const Result finer = mesh_with(surface, {}, options);
  EXPECT_GT(std::count(finer.volume.regions.begin(), finer.volume.regions.end(), 7), 200);
  // Mean lengths between two cubes around the centre: those of the region inside, longer ones outside it.
  const auto mean_between = [&](double inner, double outer) {
    return mean_edge_in(finer.volume, [&](const Point& p) {
      double away = 0;
      for (std::size_t k = 0; k < 3; ++k) away = std::max(away, std::abs(p[k] - centre[k]));
      return away >= inner && away <= outer;
    });
  };
  EXPECT_NEAR(mean_between(0, 0.42), 0.05 * (high[0] - low[0]), 0.03);
  EXPECT_GT(mean_between(0.9, 1.5), 2.5 * mean_between(0, 0.42));
}

// Powers of two change nothing; energies, products of sixteen lengths, once exceeded the exponent range.
TEST(FieldPoints, TheUnitDoesNotMatter) {
  const Surface sphere = hard::icosphere(2);
  const Result usual = mesh_with(sphere, {.size = 0.3});
  for (const int k : {-300, -160, 160, 300}) {
    Surface scaled = sphere;
    for (Point& p : scaled.vertices)
      for (double& x : p) x = std::ldexp(x, k);
    const Result result = mesh_with(scaled, {.size = std::ldexp(0.3, k)});
    EXPECT_EQ(result.volume.tetrahedra, usual.volume.tetrahedra) << k;
    EXPECT_EQ(result.report.field.after.least_dihedral, usual.report.field.after.least_dihedral) << k;
  }
}

// Marking, measuring and compression run on threads, too, from some thousands of elements on.
TEST(FieldPoints, SameResultAndFileOnAnyNumberOfThreads) {
  const Surface sphere = hard::icosphere(4);
  const samples::TemporaryFolder folder;
  const auto on = [&](unsigned threads) {
    Options options;
    options.threads = threads;
    Result result = mesh_with(sphere, {.grow = false}, options);
    WriteOptions writing;
    writing.threads = threads;
    write_volume(folder / "sphere.vtu", result.volume, writing);
    return std::pair(std::move(result), samples::get(folder / "sphere.vtu"));
  };
  const auto [one, file] = on(1);
  for (const unsigned threads : {2u, 3u}) {
    const auto [other, other_file] = on(threads);
    EXPECT_EQ(other.volume.vertices, one.volume.vertices);
    EXPECT_EQ(other.volume.tetrahedra, one.volume.tetrahedra);
    EXPECT_EQ(other_file, file);
    EXPECT_EQ(other.report.elements.histogram, one.report.elements.histogram);
    EXPECT_EQ(other.report.elements.worst, one.report.elements.worst);
    EXPECT_EQ(other.report.elements.min_dihedral_deg, one.report.elements.min_dihedral_deg);
    for (const auto shape : {&Report::Field::before, &Report::Field::after}) {
      EXPECT_EQ((other.report.field.*shape).least_dihedral, (one.report.field.*shape).least_dihedral);
      EXPECT_EQ((other.report.field.*shape).quality, (one.report.field.*shape).quality);
      EXPECT_EQ((other.report.field.*shape).max_dihedral_deg, (one.report.field.*shape).max_dihedral_deg);
    }
    EXPECT_EQ(other.report.field.edge_lengths, one.report.field.edge_lengths);
  }
}

TEST(FieldPoints, SameResultTwice) {
  const Surface sphere = hard::icosphere(3);
  const Result a = mesh_with(sphere, {}), b = mesh_with(sphere, {});
  EXPECT_EQ(a.volume.tetrahedra, b.volume.tetrahedra);
  EXPECT_EQ(a.volume.vertices, b.volume.vertices);
}

TEST(FieldPoints, LimitsAndCancelAreHeard) {
  const Surface sphere = hard::icosphere(2);
  Options options;
  options.sizes = Sizes{.size = 0.01};
  options.time_limit = 0.2;
  EXPECT_EQ(mesh(sphere.view(), options).outcome, Outcome::time_limit);
  options.time_limit = 0;
  options.progress = [](const Progress& progress) { return progress.stage != Stage::field_points; };
  EXPECT_EQ(mesh(sphere.view(), options).outcome, Outcome::cancelled);
}

TEST(FieldPoints, SizesAtVerticesFarBelowTheTriangles) {
  const Surface box = small::box();
  std::size_t before = 0;
  for (const double size : {0.2, 0.1, 0.05, 0.03, 0.02, 0.01, 0.001}) {
    const Result result = mesh_with(box, {.vertex_sizes = std::vector<double>(8, size)});
    EXPECT_GT(result.volume.tetrahedra.size(), before) << size;
    before = result.volume.tetrahedra.size();
  }
}

TEST(FieldPoints, OptionsWithoutSenseAreRefused) {
  const Surface box = small::box();
  Options options;
  options.sizes = Sizes{.size = -1};
  EXPECT_THROW(static_cast<void>(mesh(box.view(), options)), std::invalid_argument);
  options.sizes = Sizes{.vertex_sizes = {1, 2}};
  EXPECT_THROW(static_cast<void>(mesh(box.view(), options)), std::invalid_argument);
}

TEST(FieldPoints, ElementsThatFacetsForceAreReported) {
  Surface wedge;  // two triangles of a tetrahedron meet at 5 degrees
  const double h = std::tan(5 * 3.14159265358979 / 180);
  wedge.vertices = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, 1, h}};
  wedge.facets = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const Result result = mesh_with(wedge, {});
  EXPECT_GT(result.report.field.below_10_deg, 0u);
  ASSERT_GT(result.report.field.worst_forced.size(), 0u);
  EXPECT_EQ(result.report.field.worst_forced[0].facets.size(), 2u);
}

// Points inside leave no element with both facets of the wedge.
TEST(FieldPoints, ElementsInAWedgeOfTheSurfaceAreReported) {
  Surface wedge;
  const double h = 8 * std::tan(4 * 3.14159265358979 / 180);
  wedge.vertices = {{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}, {0, 8, h}, {8, 8, h}};
  wedge.facets = {{0, 2, 1}, {0, 3, 2}, {0, 1, 5}, {0, 5, 4}, {1, 2, 5}, {2, 3, 4}, {2, 4, 5}, {0, 4, 3}};
  const Result result = mesh_with(wedge, {.size = 0.5});
  const Report::Field& field = result.report.field;
  EXPECT_GT(field.below_10_deg, 0u);
  EXPECT_GT(field.forced, 0u);
  for (const Report::Forced& f : field.worst_forced) EXPECT_FALSE(f.facets.empty());
}

}  // namespace
}  // namespace holdfast::field_test
