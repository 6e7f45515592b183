// Part of a volume filled separately: with the points that it may have, or not at all.
#include "api/fill_polyhedron.h"

#include <gtest/gtest.h>

#include "number_range_surfaces.h"
#include "small_surfaces.h"

namespace holdfast::fill_polyhedron_test {
namespace {

std::optional<Filling> filled(const Surface& surface, PointsOfFilling points) {
  const Limits limits;
  const std::function<bool(const Progress&)> progress;
  Monitor whole(limits, progress);
  return fill_polyhedron(surface.view(), points, limits, whole);
}

TEST(FillPolyhedron, HasNoMorePointsThanItMay) {
  const Surface prism = number_range::schoenhardt(6, 6, 30);  // takes one, whatever the order
  EXPECT_FALSE(filled(prism, {.most_recovered = 0}));
  for (const bool may_be_added : {false, true}) {
    const std::optional<Filling> filling = filled(prism, {.most_recovered = 1, .may_be_added = may_be_added});
    ASSERT_TRUE(filling);
    EXPECT_EQ(filling->added.size(), 1U);
  }
}

TEST(FillPolyhedron, NeedsNoPointsForABox) {
  const std::optional<Filling> filling = filled(small::box(), {.most_recovered = 0, .may_be_added = false});
  ASSERT_TRUE(filling);
  EXPECT_TRUE(filling->added.empty());
  EXPECT_GE(filling->tetrahedra.size(), 5U);
}

TEST(FillPolyhedron, IsNothingWhereTheSurfaceIsNotValid) {
  Surface open = small::box();
  open.facets.pop_back();
  EXPECT_FALSE(filled(open, {}));
}

}  // namespace
}  // namespace holdfast::fill_polyhedron_test
