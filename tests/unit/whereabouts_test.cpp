// What the facets alone tell of where points lie.
#include "surface/whereabouts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "holdfast/holdfast.h"
#include "small_surfaces.h"

namespace holdfast {
namespace {

using enum Whereabouts;

std::vector<Whereabouts> find(const Surface& surface, const std::vector<Point>& points) {
  return whereabouts(surface.view(), points, [] {});
}

TEST(Whereabouts, OfABox) {
  const Surface box = small::box();
  EXPECT_EQ(find(box, {{0.3, 0.4, 0.6}}), (std::vector{open}));
  // In a facet, on a side, on a diagonal, at a corner.
  EXPECT_EQ(find(box, {{0.3, 0.4, 0}, {0.5, 0, 0}, {0.5, 0.5, 1}, {1, 1, 1}}), (std::vector(4, on_facet)));
  EXPECT_EQ(find(box, {{2, 0.5, 0.5}, {-1e300, 0, 0}, {0.5, 0.5, 1.0000000000000002}, {5, 5, 5}}),
            (std::vector(4, unbounded)));
  EXPECT_EQ(find(box, {{0.5, 0.5, 0.9999999999999999}}), (std::vector{open}));
  EXPECT_TRUE(find(box, {}).empty());
}

// Exactly on a slanted plane or one bit beside it.
TEST(Whereabouts, OfASlantedFacet) {
  Surface surface = small::box({-4, -4, -4}, {4, 4, 4});
  small::add_triangle(surface, {0, 0, 0}, {3, 0, 1}, {0, 3, 1});
  EXPECT_EQ(find(surface, {{1.5, 0, 0.5}, {0.75, 0.75, 0.5}, {0, 0, 0}}), (std::vector(3, on_facet)));
  EXPECT_EQ(find(surface, {{0.75, 0.75, 0.5000000000000001}, {1.5, -1e-300, 0.5}}), (std::vector(2, open)));
}

TEST(Whereabouts, OfManyPointsAsOfEach) {
  const Surface surface = small::nested(true);
  std::vector<Point> points;
  for (int i = -1; i < 15; ++i)
    for (int j = -1; j < 15; ++j)
      for (int k = -1; k < 15; ++k) points.push_back({i * 0.25, j * 0.25, k * 0.25});
  const std::vector<Whereabouts> all = find(surface, points);
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
    const Whereabouts expected = on_box(p, 0, 3) || on_box(p, 1, 2) ? on_facet : inside ? open : unbounded;
    EXPECT_EQ(all[i], expected) << p[0] << " " << p[1] << " " << p[2];
  }
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
}  // namespace holdfast
