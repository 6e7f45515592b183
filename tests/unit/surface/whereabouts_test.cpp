// Locations of points relative to the facets, without a mesh.
#include "surface/whereabouts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "holdfast/holdfast.h"
#include "small_surfaces.h"

namespace holdfast::whereabouts_test {
namespace {

enum Place { on_facet, unbounded, bounded };

std::vector<Whereabouts> regions_at(const Surface& surface, const std::vector<Point>& points) {
  const Complex complex = surface.view();
  return whereabouts(complex, Separation(segment_table(complex)), points, [] {});
}

std::vector<Place> find(const Surface& surface, const std::vector<Point>& points) {
  std::vector<Place> places;
  for (const Whereabouts& at : regions_at(surface, points))
    places.push_back(at.on_facet ? on_facet : at.region.empty() ? unbounded : bounded);
  return places;
}

TEST(Whereabouts, OfABox) {
  const Surface box = small::box();
  EXPECT_EQ(find(box, {{0.3, 0.4, 0.6}}), (std::vector{bounded}));
  // In a facet, on a side, on a diagonal, at a corner.
  EXPECT_EQ(find(box, {{0.3, 0.4, 0}, {0.5, 0, 0}, {0.5, 0.5, 1}, {1, 1, 1}}), (std::vector(4, on_facet)));
  EXPECT_EQ(find(box, {{2, 0.5, 0.5}, {-1e300, 0, 0}, {0.5, 0.5, 1.0000000000000002}, {5, 5, 5}}),
            (std::vector(4, unbounded)));
  EXPECT_EQ(find(box, {{0.5, 0.5, 0.9999999999999999}}), (std::vector{bounded}));
  EXPECT_TRUE(find(box, {}).empty());
}

// Exactly on a slanted plane or one bit off it.
TEST(Whereabouts, OfASlantedFacet) {
  Surface surface = small::box({-4, -4, -4}, {4, 4, 4});
  small::add_triangle(surface, {0, 0, 0}, {3, 0, 1}, {0, 3, 1});
  EXPECT_EQ(find(surface, {{1.5, 0, 0.5}, {0.75, 0.75, 0.5}, {0, 0, 0}}), (std::vector(3, on_facet)));
  EXPECT_EQ(find(surface, {{0.75, 0.75, 0.5000000000000001}, {1.5, -1e-300, 0.5}}),
            (std::vector(2, bounded)));
}

TEST(Whereabouts, OfManyPointsAsOfEach) {
  const Surface surface = small::nested(true);
  std::vector<Point> points;
  for (int i = -1; i < 15; ++i)
    for (int j = -1; j < 15; ++j)
      for (int k = -1; k < 15; ++k) points.push_back({i * 0.25, j * 0.25, k * 0.25});
  const std::vector<Place> all = find(surface, points);
  const auto on_box = [](const Point& p, double low, double high) {
    bool within = true, at = false;
    for (const double x : p) {
      within = within && x >= low && x <= high;
      at = at || x == low || x == high;
    }
    return within && at;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& p = points[i];
    const bool inside = p[0] > 0 && p[0] < 3 && p[1] > 0 && p[1] < 3 && p[2] > 0 && p[2] < 3;
    const Place expected = on_box(p, 0, 3) || on_box(p, 1, 2) ? on_facet : inside ? bounded : unbounded;
    EXPECT_EQ(all[i], expected) << p[0] << " " << p[1] << " " << p[2];
  }
}

// A cup of boxes: the space over its bottom has walls on four sides, but is open.
Surface cup() {
  Surface cup = small::box({0, 0, 0}, {3, 3, 1});
  small::add_box(cup, {5, 0, 0}, {8, 1, 3});
  small::add_box(cup, {5, 2, 0}, {8, 3, 3});
  return cup;
}

TEST(Whereabouts, BetweenWallsIsOutside) {
  EXPECT_EQ(find(cup(), {{6, 1.5, 1}, {6, 0.5, 1}, {1, 1, 0.5}, {1, 1, 2}}),
            (std::vector{unbounded, bounded, bounded, unbounded}));
}

// Centroids of tetrahedra have equal names exactly if they are in one region of the mesh. `keep box` keeps
// all.
void expect_regions_of_mesh(const Surface& surface) {
  Options options;
  options.keep = Keep::box;
  const Result result = mesh(surface.view(), options);
  ASSERT_EQ(result.outcome, Outcome::done);
  const Volume& volume = result.volume;
  std::vector<Point> centroids;
  for (const Tetrahedron& t : volume.tetrahedra) {
    Point sum{};
    for (const Index v : t)
      for (std::size_t k = 0; k < 3; ++k) sum[k] += volume.vertices[v][k] / 4;
    centroids.push_back(sum);
  }
  std::map<Separation::Region, std::set<int>> by_name;
  std::set<int> ids;
  const std::vector<Whereabouts> at = regions_at(surface, centroids);
  for (std::size_t i = 0; i < at.size(); ++i) {
    ASSERT_FALSE(at[i].on_facet);
    by_name[at[i].region].insert(volume.regions[i]);
    ids.insert(volume.regions[i]);
  }
  EXPECT_EQ(by_name.size(), ids.size());
  EXPECT_EQ(Separation(segment_table(surface.view())).enclosed() + 1, ids.size());
  for (const auto& [name, of_mesh] : by_name) EXPECT_EQ(of_mesh.size(), 1u);
}

TEST(Whereabouts, RegionsAreThoseOfTheMesh) {
  expect_regions_of_mesh(small::nested(true));
  expect_regions_of_mesh(small::touching());
  expect_regions_of_mesh(small::open_box());
  Surface with_sheet = small::nested(false);
  small::add_triangle(with_sheet, {0.25, 0.25, 0.25}, {0.75, 0.25, 0.25}, {0.25, 0.75, 0.75});
  expect_regions_of_mesh(with_sheet);
}

// Eight cells of a cube with all walls between them, of which any may be missing.
Surface cells(unsigned walls) {
  Surface surface = small::surface_of({}, {});
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 3; ++z)
        surface.vertices.push_back({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
  const auto at = [](std::array<int, 3> p) { return static_cast<Index>(9 * p[0] + 3 * p[1] + p[2]); };
  unsigned inner = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 3; ++side)
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) {
          if (side == 1 && (walls >> inner++ & 1) == 0) continue;
          const auto corner = [&](int u, int v) {
            std::array<int, 3> p{};
            p[axis] = side;
            p[(axis + 1) % 3] = i + u;
            p[(axis + 2) % 3] = j + v;
            return at(p);
          };
          surface.facets.push_back({corner(0, 0), corner(1, 0), corner(1, 1)});
          surface.facets.push_back({corner(0, 0), corner(1, 1), corner(0, 1)});
        }
  return surface;
}

TEST(Whereabouts, CellsWithAnyWalls) {
  for (unsigned walls = 0; walls < 4096; walls += 37) {
    SCOPED_TRACE(walls);
    expect_regions_of_mesh(cells(walls));
  }
}

TEST(Whereabouts, SeedsOfOneRegionAreRefusedBeforeTheLongWork) {
  const Surface surface = small::nested(true);
  const auto refusal = [&](const Options& given) {
    Options options = given;
    Stage last = Stage::validate;
    options.progress = [&](const Progress& progress) {
      last = progress.stage;
      return true;
    };
    std::string message;
    try {
      static_cast<void>(mesh(surface.view(), options));
    } catch (const std::invalid_argument& error) {
      message = error.what();
    }
    EXPECT_EQ(last, Stage::validate);
    return message;
  };
  Options two;
  two.regions = {{{0.5, 0.5, 0.5}, 1}, {{1.5, 1.5, 1.5}, 2}, {{2.5, 2.5, 2.5}, 3}};
  EXPECT_NE(refusal(two).find("gives id 3 to a region that another seed calls 1"), std::string::npos);
  Options hole;
  hole.regions = {{{0.5, 0.5, 0.5}, 1}};
  hole.holes = {{2.5, 2.5, 2.5}};
  EXPECT_NE(refusal(hole).find("in a region that is not kept"), std::string::npos);
  two.regions.pop_back();
  EXPECT_EQ(mesh(surface.view(), two).outcome, Outcome::done);
}

// A wall that lacks a triangle: its border is the place to look at.
TEST(Whereabouts, SeedsBesideAnOpenBorder) {
  Surface surface = cells(0xf);
  const std::size_t wall = 2 * 4;  // the first facet of the wall across the first axis
  surface.facets.erase(surface.facets.begin() + wall);
  Options options;
  options.regions = {{{0.5, 0.5, 0.5}, 1}, {{1.5, 1.5, 1.5}, 2}};
  try {
    static_cast<void>(mesh(surface.view(), options));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what())
                  .find("close the open border of the triangles inside this region, at vertex 13 "),
              std::string::npos)
        << error.what();
  }
}

// Both ends of the border's only edge lie on the rest of the surface.
TEST(Whereabouts, SeedsBesideAMissingTriangle) {
  Surface surface;
  for (const double x : {0.0, 1.0, 2.0})
    for (const double y : {0.0, 1.0})
      for (const double z : {0.0, 1.0}) surface.vertices.push_back({x, y, z});
  surface.facets = {{0, 1, 3}, {0, 3, 2}, {8, 10, 11}, {8, 11, 9}, {4, 5, 7}};
  for (const Index a : {Index{0}, Index{4}}) {
    const auto side = [&](Index p, Index q) {
      surface.facets.push_back({a + p, a + q, a + q + 4});
      surface.facets.push_back({a + p, a + q + 4, a + p + 4});
    };
    side(0, 1);
    side(1, 3);
    side(3, 2);
    side(2, 0);
  }
  Options options;
  options.regions = {{{0.5, 0.5, 0.5}, 1}, {{1.5, 0.5, 0.5}, 2}};
  try {
    static_cast<void>(mesh(surface.view(), options));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what())
                  .find("close the open border of the triangles inside this region, at vertex 4 (1, 0, 0)"),
              std::string::npos)
        << error.what();
  }
}

// A surface that crosses itself has no regions: its defects are reported.
TEST(Whereabouts, DefectsComeBeforeSeeds) {
  Surface crossing = small::box();
  small::add_box(crossing, {0.5, 0.5, 0.5}, {1.5, 1.5, 1.5});
  Options options;
  options.regions = {{{0.25, 0.25, 0.3}, 1}, {{0.3, 0.25, 0.25}, 2}};
  EXPECT_EQ(mesh(crossing.view(), options).outcome, Outcome::invalid_input);
}

// Before there are tetrahedra.
TEST(Whereabouts, OptionsAreRefusedBeforeTheLongWork) {
  const Surface box = small::box();
  for (const Point& p : {Point{0.5, 0.5, 0}, Point{2, 2, 2}, Point{0.5, 0.5, 7}}) {
    for (const bool is_hole : {true, false}) {
      Options options;
      if (is_hole)
        options.holes = {p};
      else
        options.regions = {{p, 1}};
      Stage last = Stage::validate;
      options.progress = [&](const Progress& progress) {
        last = progress.stage;
        return true;
      };
      EXPECT_THROW(static_cast<void>(mesh(box.view(), options)), std::invalid_argument);
      EXPECT_EQ(last, Stage::validate);
      options.keep = Keep::box;
      EXPECT_THROW(static_cast<void>(mesh(box.view(), options)), std::invalid_argument);
      EXPECT_EQ(last, Stage::validate);
    }
  }
  Options options;
  options.keep = Keep::box;
  options.holes = {{1.05, 0.5, 0.5}};  // in the box, outside the surface
  EXPECT_EQ(mesh(box.view(), options).outcome, Outcome::done);
}

TEST(Whereabouts, NumbersThatMakeNoSenseAreRefused) {
  const Surface box = small::box();
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const auto refused = [&](const Options& options) {
    EXPECT_THROW(static_cast<void>(mesh(box.view(), options)), std::invalid_argument);
  };
  for (const double x : {nan, -1.0}) {
    Options options;
    options.time_limit = x;
    refused(options);
    options = {};
    options.sizes = Sizes{.vertex_sizes = std::vector<double>(8, x)};
    refused(options);
  }
  for (const double x : {nan, -1.0, infinity}) {
    Options options;
    options.regions = {{{0.4, 0.5, 0.6}, 1, x}};
    refused(options);
    options = {};
    options.sizes = Sizes{.size = x};
    refused(options);
  }
}

}  // namespace
}  // namespace holdfast::whereabouts_test
