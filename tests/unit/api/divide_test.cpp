// Surfaces in parts: the parts are valid, fit, and together are the whole.
#include "holdfast/divide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "holdfast/check.h"
#include "small_surfaces.h"

namespace holdfast::divide_test {
namespace {

double volume_of(const Volume& volume) {
  double sum = 0;
  for (const Tetrahedron& t : volume.tetrahedra) {
    const Point& a = volume.vertices[t[0]];
    std::array<Point, 3> e{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) e[i][k] = volume.vertices[t[i + 1]][k] - a[k];
    sum += (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
            e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
            e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
           6;
  }
  return sum;
}

std::vector<Volume> mesh_parts(const SurfaceDivision& division) {
  std::vector<Volume> volumes;
  for (const SurfacePart& part : division.parts) {
    EXPECT_TRUE(diagnose(part.surface.view()).empty());
    Options options;
    options.sizes = Sizes{};
    options.holes = part.surface.holes;
    options.regions = part.surface.regions;
    Result result = mesh(part.surface, options);
    EXPECT_EQ(result.outcome, Outcome::done) << result.message;
    EXPECT_TRUE(check(part.surface.view(), result.volume).holds());
    volumes.push_back(std::move(result.volume));
  }
  return volumes;
}

bool fits(const Surface& surface, const std::vector<Volume>& volumes) {
  FitChecker checker(surface.view());
  for (const Volume& volume : volumes) checker.add(volume);
  const std::vector<Fit> all = checker.finish();
  return std::all_of(all.begin(), all.end(), [](const Fit& fit) { return fit.holds; });
}

DivideOptions in_parts(std::size_t parts, double size) {
  DivideOptions options;
  options.parts = parts;
  options.size = size;
  return options;
}

/// Divides, meshes the parts, and joins them into a volume that keeps the surface.
void expect_whole(const Surface& surface, const DivideOptions& options, double volume) {
  const SurfaceDivision division = divide(surface, options);
  ASSERT_EQ(division.outcome, Outcome::done) << division.message;
  EXPECT_EQ(division.parts.size(), options.parts);
  const std::vector<Volume> volumes = mesh_parts(division);
  EXPECT_TRUE(fits(surface, volumes));
  const Volume joined = join_parts(surface.view(), volumes, division.interface_marker);
  const CheckResult result = check(surface.view(), joined);
  for (const Rule& rule : result.rules) EXPECT_TRUE(rule.holds) << rule.name << ": " << rule.detail;
  EXPECT_NEAR(volume_of(joined), volume, 1e-9 * volume);
}

TEST(Divide, PartsOfABoxAreTheBox) {
  for (const std::size_t parts : {1u, 2u, 3u, 8u}) expect_whole(small::box(), in_parts(parts, 0.12), 1);
}

TEST(Divide, ACavityStaysEmptyWhicheverPartHoldsIt) {
  expect_whole(small::nested(false), in_parts(4, 0.3), 26);
  Surface turned = small::nested(true);
  DivideOptions options = in_parts(2, 0.3);
  options.holes = {{1.5, 1.5, 1.5}};
  expect_whole(turned, options, 26);
}

TEST(Divide, RegionsKeepTheirIdsAndSizes) {
  Surface surface = small::touching();
  DivideOptions options = in_parts(4, 0.3);
  options.regions = {{{0.5, 0.5, 0.5}, 7, 0.15}, {{1.5, 0.5, 0.5}, 9}};
  const SurfaceDivision division = divide(surface, options);
  ASSERT_EQ(division.outcome, Outcome::done);
  const std::vector<Volume> volumes = mesh_parts(division);
  EXPECT_TRUE(fits(surface, volumes));
  const Volume joined = join_parts(surface.view(), volumes, division.interface_marker);
  EXPECT_TRUE(check(surface.view(), joined).holds());
  std::map<int, std::size_t> count;
  for (std::size_t t = 0; t < joined.tetrahedra.size(); ++t) ++count[joined.regions[t]];
  ASSERT_EQ(count.size(), 2u);
  EXPECT_GT(count[7], 3 * count[9]);
  for (std::size_t t = 0; t < joined.tetrahedra.size(); ++t)
    for (const Index v : joined.tetrahedra[t])
      EXPECT_TRUE(joined.regions[t] == 7 ? joined.vertices[v][0] <= 1 : joined.vertices[v][0] >= 1);
}

TEST(Divide, DanglingSegmentsAndIsolatedPointsArePartsToo) {
  Surface surface = small::box();
  surface.vertices.push_back({0.3, 0.4, 0.5});
  surface.vertices.push_back({0.7, 0.6, 0.5});
  surface.vertices.push_back({0.9, 0.1, 0.2});
  surface.segments = {{8, 9}};
  surface.segment_markers = {5};
  expect_whole(surface, in_parts(3, 0.15), 1);
}

TEST(Divide, InterfacesAreMarkedAboveAllMarkers) {
  Surface surface = small::box();
  surface.facet_markers.assign(12, 4);
  const SurfaceDivision division = divide(surface, in_parts(2, 0.2));
  EXPECT_EQ(division.interface_marker, 5);
  for (const SurfacePart& part : division.parts) {
    const auto& markers = part.surface.facet_markers;
    EXPECT_GT(part.interface_facets, 0u);
    EXPECT_EQ(static_cast<std::size_t>(std::count(markers.begin(), markers.end(), 5)), part.interface_facets);
  }
}

TEST(Divide, TheWorkIsShared) {
  const SurfaceDivision division = divide(small::box(), in_parts(8, 0.06));
  ASSERT_EQ(division.parts.size(), 8u);
  double least = HUGE_VAL, most = 0;
  for (const SurfacePart& part : division.parts) {
    least = std::min(least, part.tetrahedra);
    most = std::max(most, part.tetrahedra);
  }
  EXPECT_LT(most, 1.5 * least);
}

TEST(Divide, IsTheSameEveryTime) {
  DivideOptions options = in_parts(4, 0.15);
  const SurfaceDivision one = divide(small::box(), options);
  options.threads = 2;
  const SurfaceDivision other = divide(small::box(), options);
  ASSERT_EQ(one.parts.size(), other.parts.size());
  for (std::size_t k = 0; k < one.parts.size(); ++k) {
    EXPECT_EQ(one.parts[k].surface.vertices, other.parts[k].surface.vertices);
    EXPECT_EQ(one.parts[k].surface.facets, other.parts[k].surface.facets);
  }
}

TEST(Divide, RefusesWhatMeshRefuses) {
  Surface surface = small::box();
  surface.facets.pop_back();
  EXPECT_EQ(divide(surface, in_parts(2, 0.2)).outcome, Outcome::invalid_input);
  EXPECT_THROW(static_cast<void>(divide(small::box(), in_parts(0, 0.2))), std::invalid_argument);
}

TEST(Divide, NoMorePartsThanTetrahedra) {
  const SurfaceDivision division = divide(small::box(), in_parts(std::size_t{1} << 50u, 0.5));
  ASSERT_EQ(division.outcome, Outcome::done);
  double expected = 0;
  for (const SurfacePart& part : division.parts) expected += part.tetrahedra;
  EXPECT_LE(static_cast<double>(division.parts.size()), expected);
  EXPECT_GT(division.parts.size(), 1U);
}

class FitCheckerTest : public ::testing::Test {
 protected:
  Surface surface = small::box();
  SurfaceDivision division = divide(surface, in_parts(3, 0.2));
  std::vector<Volume> volumes = mesh_parts(division);

  std::vector<bool> verdict() const {
    FitChecker checker(surface.view());
    for (const Volume& volume : volumes) checker.add(volume);
    std::vector<bool> holds;
    for (const Fit& fit : checker.finish()) holds.push_back(fit.holds);
    return holds;
  }
};

TEST_F(FitCheckerTest, FindsAMissingPart) {
  volumes.pop_back();
  EXPECT_FALSE(verdict()[3]);
}

TEST_F(FitCheckerTest, FindsAPartThatIsThereTwice) {
  volumes.push_back(volumes[0]);
  EXPECT_FALSE(verdict()[4]);
}

TEST_F(FitCheckerTest, FindsAPartWhoseRegionHasAnotherNumber) {
  EXPECT_TRUE(verdict()[3]);
  std::fill(volumes[1].regions.begin(), volumes[1].regions.end(), 33);
  EXPECT_FALSE(verdict()[3]);
}

TEST_F(FitCheckerTest, FindsAnInterfaceThatIsOffByTheLastBit) {
  Volume& part = volumes[1];
  for (std::size_t f = 0; f < part.facets.size(); ++f) {
    if (part.facet_markers[f] != division.interface_marker) continue;
    for (const Index v : part.facets[f]) {
      if (part.vertices[v][0] == 0 || part.vertices[v][0] == 1) continue;
      part.vertices[v][0] = std::nextafter(part.vertices[v][0], 2);
      EXPECT_FALSE(verdict()[3]);
      return;
    }
  }
  FAIL() << "no interface";
}

}  // namespace
}  // namespace holdfast::divide_test
