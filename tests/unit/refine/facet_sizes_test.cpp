// What sizes facets can bear: need, fall with the distance, clearance. How fast sizes grow by default.
#include "size/facet_sizes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "checked_mesh.h"
#include "hard_surfaces.h"
#include "numbers/vector.h"
#include "size/tuning.h"

namespace holdfast::facet_sizes_test {
namespace {

using testing::mesh_with;

FacetSizes::Facet right_triangle(double side, double wanted, double z = 0) {
  return {{{{0, 0, z}, {side, 0, z}, {0, side, z}}}, wanted};
}

TEST(FacetSizes, WhatCanBearTheWantedSizeIsLeftOut) {
  EXPECT_TRUE(FacetSizes(std::array{right_triangle(1, 1)}).empty());
  EXPECT_TRUE(FacetSizes().empty());
  EXPECT_EQ(FacetSizes(std::array{right_triangle(1, 1), right_triangle(1, 0.01)}).count(), 1u);
  EXPECT_EQ(FacetSizes(std::array{right_triangle(1, 1)}).bearable({0, 0, 0}, 0.5), 0.5);
}

TEST(FacetSizes, NeedFallsWithTheDistance) {
  const double most = tuning::kMostNeed * 0.01;
  const FacetSizes sizes(std::array{right_triangle(1, 0.01)});
  EXPECT_DOUBLE_EQ(sizes.bearable({0.2, 0.2, 0}, 0.01), most);
  EXPECT_NEAR(sizes.bearable({0.2, 0.2, 0.01}, 0.01), most - tuning::kFallOfNeed * 0.01, 1e-15);
  EXPECT_NEAR(sizes.bearable({-0.006, -0.008, 0}, 0.01), most - tuning::kFallOfNeed * 0.01, 1e-15);
  EXPECT_EQ(sizes.bearable({0.2, 0.2, 0.01}, 0.05), 0.05);
  EXPECT_EQ(sizes.bearable({0.2, 0.2, 1}, 0.01), 0.01);
  const FacetSizes needle(std::array{FacetSizes::Facet{{{{0, 0, 0}, {1, 0, 0}, {1, 1e-3, 0}}}, 0.15}});
  EXPECT_DOUBLE_EQ(needle.bearable({0.5, 0, 0}, 0.1), tuning::kNeedOfFacet * std::hypot(1, 1e-3));
}

TEST(FacetSizes, PointsKeepAwayAlsoBesideTheMiddle) {
  const FacetSizes sizes(std::array{right_triangle(1, 0.01)});
  for (const Point& p : {Point{0.3, 0.3, 0}, Point{0.01, 0.9, 0}})
    for (const double sign : {1.0, -1.0}) {
      EXPECT_TRUE(sizes.is_too_near({p[0], p[1], sign * 1e-3}, 0.01));
      EXPECT_FALSE(sizes.is_too_near({p[0], p[1], sign * tuning::kMostNeed * 0.01}, 0.01));
    }
}

// If a function of the user gives the sizes, facets need at most a fixed multiple of them, at any place.
TEST(FacetSizes, WhatIsWantedMayDifferFromPlaceToPlace) {
  const FacetSizes sizes(std::array{right_triangle(1, 1)}, FacetSizes::Wanted::anywhere);
  EXPECT_EQ(sizes.count(), 1u);
  for (const double wanted : {0.001, 0.01}) {
    EXPECT_DOUBLE_EQ(sizes.bearable({0.2, 0.2, 0}, wanted), tuning::kMostNeed * wanted);
    EXPECT_NEAR(sizes.bearable({0.2, 0.2, wanted}, wanted),
                (tuning::kMostNeed - tuning::kFallOfNeed) * wanted, 1e-15);
    EXPECT_TRUE(sizes.is_too_near({0.3, 0.3, 0.1 * wanted}, wanted));
    EXPECT_FALSE(sizes.is_too_near({0.3, 0.3, tuning::kMostNeed * wanted}, wanted));
  }
  EXPECT_EQ(sizes.bearable({0.2, 0.2, 0}, 0.5), 0.5);
  EXPECT_FALSE(sizes.is_too_near({0.3, 0.3, 0.01}, 0.5));
}

// A facet on which only the user wants smaller elements does not count where the surface itself is finer.
TEST(FacetSizes, WhatTheUserAsksForDoesNotMakeSizesOfTheSurfaceLarger) {
  FacetSizes::Facet asked = right_triangle(1, 0.01);
  asked.is_asked = true;
  const Point x{0.2, 0.2, 0.001};
  const double size = 0.005;
  const FacetSizes of_user(std::array{asked}), of_surface(std::array{right_triangle(1, 0.01)});
  EXPECT_GT(of_user.bearable(x, size, FacetSizes::By::user), size);
  EXPECT_TRUE(of_user.is_too_near(x, size, FacetSizes::By::user));
  EXPECT_EQ(of_user.bearable(x, size, FacetSizes::By::surface), size);
  EXPECT_FALSE(of_user.is_too_near(x, size, FacetSizes::By::surface));
  EXPECT_GT(of_surface.bearable(x, size, FacetSizes::By::surface), size);
  EXPECT_TRUE(of_surface.is_too_near(x, size, FacetSizes::By::surface));
}

// The user's size can be made up for elsewhere, so elements next to a facet may be larger, and points are
// farther from it.
TEST(FacetSizes, AFacetNeedsMoreWhereTheUserAsks) {
  const double wanted = 0.01;
  FacetSizes::Facet asked = right_triangle(1, wanted);
  asked.is_asked = true;
  const Point x{0.2, 0.2, 0};
  const auto most = [&](const FacetSizes& sizes) { return sizes.bearable(x, wanted); };
  const double whole = tuning::kMostNeedWhereAsked * wanted;
  EXPECT_DOUBLE_EQ(most(FacetSizes(std::array{asked})), whole);
  EXPECT_DOUBLE_EQ(most(FacetSizes(std::array{asked}, FacetSizes::Wanted::at_corners, 1, 0.6)), 0.6 * whole);
  EXPECT_DOUBLE_EQ(most(FacetSizes(std::array{asked}, FacetSizes::Wanted::anywhere, 1, 0.6)),
                   tuning::kMostNeed * wanted);
  EXPECT_DOUBLE_EQ(
      most(FacetSizes(std::array{right_triangle(1, wanted)}, FacetSizes::Wanted::at_corners, 1, 0.6)),
      tuning::kMostNeed * wanted);
  const double clearance = tuning::kClearanceWhereAsked;
  const double height = clearance * whole / (1 + clearance * tuning::kFallOfNeed);
  const FacetSizes sizes(std::array{asked});
  EXPECT_TRUE(sizes.is_too_near({0.2, 0.2, 0.99 * height}, wanted));
  EXPECT_FALSE(sizes.is_too_near({0.2, 0.2, 1.01 * height}, wanted));
}

// The tree finds the same as a search over all facets.
TEST(FacetSizes, AllAreAsEachAlone) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> any(0, 1);
  std::vector<FacetSizes::Facet> facets(200);
  for (FacetSizes::Facet& f : facets) {
    const Point at{any(random), any(random), any(random)};
    const double size = 0.3 * any(random);
    for (Point& p : f.corners)
      for (std::size_t k = 0; k < 3; ++k) p[k] = at[k] + size * any(random);
    f.wanted = 0.02 * any(random);
    f.is_asked = any(random) < 0.5;
  }
  const FacetSizes all(facets);
  for (int k = 0; k < 500; ++k) {
    const Point x{any(random), any(random), any(random)};
    double most = 0.001;
    bool is_near = false;
    for (const FacetSizes::Facet& f : facets) {
      const FacetSizes alone(std::array{f});
      most = std::max(most, alone.bearable(x, 0.001));
      is_near = is_near || alone.is_too_near(x, 0.001);
    }
    EXPECT_EQ(all.bearable(x, 0.001), most);
    EXPECT_EQ(all.is_too_near(x, 0.001), is_near);
  }
}

// Each of the first `count` triangles gets a smaller one of its shape inside, which takes its number.
Surface with_insets(Surface surface, std::size_t count, double part) {
  for (std::size_t f = 0; f < count; ++f) {
    const Triangle outer = surface.facets[f];
    Triangle inner{};
    for (std::size_t i = 0; i < 3; ++i) {
      Point p{};
      for (std::size_t k = 0; k < 3; ++k)
        for (const Index v : outer)
          p[k] += surface.vertices[v][k] * (v == outer[i] ? (1 + 2 * part) / 3 : (1 - part) / 3);
      inner[i] = static_cast<Index>(surface.vertices.size());
      surface.vertices.push_back(p);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      surface.facets.push_back({outer[i], outer[j], inner[j]});
      surface.facets.push_back({outer[i], inner[j], inner[i]});
    }
    surface.facets[f] = inner;
  }
  return surface;
}

// Each innermost triangle, with 60 of the 132 vertices, is a twentieth of the triangle around it.
Surface with_jumps() { return with_insets(with_insets(hard::icosphere(0), 20, 0.1), 20, 0.5); }

TEST(Gradation, SizesGrowFasterWhereThoseOfTheSurfaceJump) {
  // The mesh of the gradation that the surface asks for over that of the least such.
  const auto part = [](const Surface& surface) {
    const auto count = [&](std::optional<double> gradation) {
      return static_cast<double>(mesh_with(surface, {.gradation = gradation}).volume.tetrahedra.size());
    };
    return count({}) / count(0.3);
  };
  EXPECT_LT(part(with_jumps()), 0.9);
  EXPECT_NEAR(part(hard::icosphere(2)), 1, 0.05);
}

TEST(Front, PutsFewerPointsWhereSizesOfTheSurfaceJumpAndNobodyAsksForOthers) {
  // Those of the front over the same with a size that is asked for, but larger than any there.
  const auto part = [](const Surface& surface) {
    const auto count = [&](double size) {
      Options options;
      options.stop_after = Stage::field_points;
      return static_cast<double>(
          mesh_with(surface, {.size = size, .gradation = 0.5}, options).report.field.points);
    };
    return count(0) / count(2);
  };
  EXPECT_LT(part(with_jumps()), 0.95);
  EXPECT_EQ(part(hard::icosphere(2)), 1);
}

TEST(SizeOfAllRegions, AboveAllSizesOfTheSurfaceIsNone) {
  const Result none = mesh_with(with_jumps(), {}), idle = mesh_with(with_jumps(), {.size = 1000});
  EXPECT_EQ(idle.volume.vertices, none.volume.vertices);
  EXPECT_EQ(idle.volume.tetrahedra, none.volume.tetrahedra);
  const auto tetrahedra_in_box = [&](double size) {
    Options box;
    box.keep = Keep::box;
    box.box_margin = 5;
    box.sizes = Sizes{.size = size};
    const Surface surface = hard::icosphere(0);
    return mesh(surface.view(), box).volume.tetrahedra.size();
  };
  EXPECT_GT(tetrahedra_in_box(2.2), 2 * tetrahedra_in_box(0));
}

}  // namespace
}  // namespace holdfast::facet_sizes_test
