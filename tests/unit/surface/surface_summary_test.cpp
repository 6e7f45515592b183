// Defects grouped by cause, vertices that are almost one, and what a surface encloses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "holdfast/holdfast.h"
#include "holdfast/summary.h"
#include "small_surfaces.h"

namespace holdfast::surface_summary_test {
namespace {

using namespace small;

DefectSummary summary_of(const Surface& surface) {
  const std::vector<Defect> defects = diagnose(surface.view());
  return summarise(surface.view(), defects);
}

std::optional<std::size_t> enclosed(const Surface& surface) { return summary_of(surface).enclosed; }

const DefectGroup* find(const DefectSummary& summary, Cause cause) {
  const auto at = std::find_if(summary.groups.begin(), summary.groups.end(),
                               [&](const DefectGroup& group) { return group.cause == cause; });
  return at == summary.groups.end() ? nullptr : &*at;
}

TEST(Enclosed, CountsBoundedRegions) {
  EXPECT_EQ(enclosed(box()), 1u);
  EXPECT_EQ(enclosed(nested(true)), 2u);
  EXPECT_EQ(enclosed(touching()), 2u);
  EXPECT_EQ(enclosed(open_box()), 0u);
  EXPECT_EQ(enclosed(surface_of({{0, 0, 0}}, {})), 0u);
  Surface with_sheet = touching();
  add_triangle(with_sheet, {5, 0, 0}, {6, 0, 0}, {5, 1, 0});
  EXPECT_EQ(enclosed(with_sheet), 2u);
}

// Two boxes with the wall between them, which lacks a triangle: one region, and the other triangle dangles.
TEST(Enclosed, AWallWithAHoleDividesNothing) {
  Surface surface = touching();
  surface.facets.pop_back();
  EXPECT_EQ(enclosed(surface), 1u);
}

// A house with two rooms (Bing): no border, every segment has two or three facets, and nothing is enclosed. A
// grid of unit squares; each room is entered through a chimney that passes the other room.
TEST(Enclosed, AHouseWithoutABorderMayEncloseNothing) {
  Surface surface;
  constexpr Index n = 8;
  const auto vertex = [&](Index x, Index y, Index z) { return (z * n + y) * n + x; };
  for (Index z = 0; z < 3; ++z)
    for (Index y = 0; y < n; ++y)
      for (Index x = 0; x < n; ++x)
        surface.vertices.push_back({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
  const auto square = [&](Index a, Index b, Index c, Index d) {
    surface.facets.push_back({a, b, c});
    surface.facets.push_back({a, c, d});
  };
  // 5 x 3 squares; chimneys over (1, 1) below and over (3, 1) above, with walls to the outer wall y = 0.
  for (Index z = 0; z < 3; ++z)
    for (Index y = 0; y < 3; ++y)
      for (Index x = 0; x < 5; ++x) {
        const bool left = x == 1 && y == 1, right = x == 3 && y == 1;
        if ((z == 0 && left) || (z == 1 && (left || right)) || (z == 2 && right)) continue;
        square(vertex(x, y, z), vertex(x + 1, y, z), vertex(x + 1, y + 1, z), vertex(x, y + 1, z));
      }
  const auto wall = [&](Index x0, Index y0, Index x1, Index y1, Index z) {
    square(vertex(x0, y0, z), vertex(x1, y1, z), vertex(x1, y1, z + 1), vertex(x0, y0, z + 1));
  };
  for (Index z = 0; z < 2; ++z) {
    for (Index x = 0; x < 5; ++x) wall(x, 0, x + 1, 0, z), wall(x, 3, x + 1, 3, z);
    for (Index y = 0; y < 3; ++y) wall(0, y, 0, y + 1, z), wall(5, y, 5, y + 1, z);
    // The chimney through this storey, and the wall that joins it to the outer one.
    const Index x = z == 0 ? 1 : 3;
    wall(x, 1, x + 1, 1, z), wall(x, 2, x + 1, 2, z), wall(x, 1, x, 2, z), wall(x + 1, 1, x + 1, 2, z);
    wall(x, 0, x, 1, z);
  }
  ASSERT_TRUE(diagnose(surface.view()).empty());
  const DefectSummary summary = summary_of(surface);
  EXPECT_TRUE(summary.border.empty());
  EXPECT_EQ(summary.enclosed, 0u);
  EXPECT_EQ(mesh(surface.view()).outcome, Outcome::invalid_input);
}

// Random sets of squares of a grid: the mesher counts regions by flooding.
TEST(Enclosed, IsWhatTheMesherFinds) {
  std::mt19937 random(5);
  std::size_t total = 0;
  for (int round = 0; round < 40; ++round) {
    Surface surface;
    constexpr Index n = 4;
    const auto vertex = [&](const std::array<Index, 3>& p) { return (p[2] * n + p[1]) * n + p[0]; };
    for (Index z = 0; z < n; ++z)
      for (Index y = 0; y < n; ++y)
        for (Index x = 0; x < n; ++x)
          surface.vertices.push_back(
              {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
    const unsigned kept = 60 + static_cast<unsigned>(round);  // of a hundred
    for (unsigned axis = 0; axis < 3; ++axis)
      for (Index i = 0; i < n; ++i)
        for (Index j = 0; j + 1 < n; ++j)
          for (Index k = 0; k + 1 < n; ++k) {
            if (random() % 100 >= kept) continue;
            const auto at = [&](Index u, Index v) {
              std::array<Index, 3> p{};
              p[axis] = i, p[(axis + 1) % 3] = j + u, p[(axis + 2) % 3] = k + v;
              return vertex(p);
            };
            surface.facets.push_back({at(0, 0), at(1, 0), at(1, 1)});
            surface.facets.push_back({at(0, 0), at(1, 1), at(0, 1)});
          }
    Options options;
    options.keep = Keep::bounded;
    options.drop_outside = true;
    const Result result = mesh(surface.view(), options);
    const std::size_t regions = result.outcome == Outcome::done ? result.report.regions : 0;
    EXPECT_EQ(enclosed(surface), regions) << "round " << round;
    total += regions;
  }
  EXPECT_GT(total, 100u);
}

TEST(Gaps, ALooseLidIsACrack) {
  Surface surface = open_box();
  const auto first = static_cast<Index>(surface.vertices.size());
  for (Index v = 4; v < 8; ++v) {
    surface.vertices.push_back(surface.vertices[v]);
    surface.vertices.back()[2] += 1e-7 * (v - 3);
  }
  surface.facets.push_back({first, first + 1, first + 3});
  surface.facets.push_back({first, first + 3, first + 2});
  const DefectSummary summary = summary_of(surface);
  ASSERT_EQ(summary.gaps.size(), 4u);
  for (Index k = 0; k < 4; ++k) {  // the widest first
    const Gap& gap = summary.gaps[k];
    EXPECT_EQ(gap.vertex, 7 - k);
    EXPECT_EQ(gap.other, (Segment{first + 3 - k, first + 3 - k}));
    EXPECT_NEAR(gap.distance, 1e-7 * (4 - k), 1e-15);
    EXPECT_TRUE(gap.open);
  }
  const DefectGroup* crack = find(summary, Cause::crack);
  ASSERT_NE(crack, nullptr);
  EXPECT_EQ(crack->count, 4u);
  EXPECT_EQ(find(summary, Cause::open_border)->count, 8u);
}

TEST(Gaps, AreRelativeToTheEdgesNearby) {
  for (const double scale : {1e-200, 1.0, 1e200}) {
    for (const bool close : {true, false}) {
      Surface surface = open_box();
      surface.facets.push_back({8, 9, 11});
      surface.facets.push_back({8, 11, 10});
      for (Index v = 4; v < 8; ++v) {
        surface.vertices.push_back(surface.vertices[v]);
        surface.vertices.back()[2] += close ? 0.018 : 0.022;
      }
      for (Point& p : surface.vertices)
        for (double& x : p) x *= scale;
      EXPECT_EQ(summarise(surface.view(), {}).gaps.size(), close ? 4u : 0u) << scale;
    }
  }
}

TEST(Gaps, ANeedleIsNotAGap) {
  const std::vector<Point> points{{0, 0, 0}, {1, 0, 0}, {0.5, 1e-9, 0}, {0.5, 1, 0}};
  EXPECT_TRUE(summary_of(surface_of(points, {{0, 1, 2}})).gaps.empty());
  EXPECT_TRUE(summary_of(surface_of(points, {{0, 1, 2}, {0, 2, 3}, {2, 1, 3}})).gaps.empty());
}

// Programs split vertices at seams.
TEST(Summary, VerticesAtOnePlaceAreOne) {
  const Surface whole = box();
  Surface split;
  for (const Triangle& f : whole.facets)
    add_triangle(split, whole.vertices[f[0]], whole.vertices[f[1]], whole.vertices[f[2]]);
  const DefectSummary summary = summary_of(split);
  EXPECT_EQ(summary.parts, 1u);
  EXPECT_TRUE(summary.border.empty());
  EXPECT_TRUE(summary.groups.empty());
  EXPECT_EQ(summary.enclosed, std::size_t{1});
}

TEST(Summary, EveryDefectHasOneGroup) {
  Surface surface = box();
  add_box(surface, {0.5, 0.5, 0.5}, {2, 2, 2});
  surface.facets.push_back(surface.facets[3]);
  surface.facets.push_back({0, 1, 99});
  surface.facets.push_back({0, 0, 1});
  surface.vertices.push_back({0, 0, NAN});
  surface.segments.push_back({0, static_cast<Index>(surface.vertices.size() - 1)});
  surface.segments.push_back({2, 2});
  surface.segments.push_back({0, 7});
  const std::vector<Defect> defects = diagnose(surface.view());
  const DefectSummary summary = summarise(surface.view(), defects);
  std::vector<std::size_t> all;
  for (const DefectGroup& group : summary.groups) {
    all.insert(all.end(), group.defects.begin(), group.defects.end());
    EXPECT_FALSE(group.message.empty());
    EXPECT_EQ(group.message.find("--"), std::string::npos) << "options belong to the program";
  }
  std::sort(all.begin(), all.end());
  ASSERT_EQ(all.size(), defects.size());
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], i);
  for (const Cause cause :
       {Cause::not_finite, Cause::bad_index, Cause::no_extent, Cause::repeated_facet, Cause::parts_cross})
    EXPECT_NE(find(summary, cause), nullptr) << name(cause);
}

}  // namespace
}  // namespace holdfast::surface_summary_test
