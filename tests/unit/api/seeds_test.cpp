// Seeds of the regions of pasted parts (docs/pasting.md).
#include "holdfast/seeds.h"

#include <gtest/gtest.h>

#include <set>

#include "small_surfaces.h"

namespace holdfast::seeds_test {
namespace {

Surface tetrahedron(std::vector<Point> corners) {
  return small::surface_of(std::move(corners), {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}});
}

/// Parts that have triangles in common, which are left as they are.
PasteResult joined(const std::vector<Surface>& parts) {
  PasteOptions options;
  options.cut = false;
  return paste(parts, options);
}

TEST(Seeds, AreOnesOfThePartsRegions) {
  const std::vector<Surface> parts{small::box({0, 0, 0}, {1, 1, 1}), small::box({1, 0, 0}, {2, 1, 1})};
  const Surface seeded = with_seeds(joined(parts));
  ASSERT_EQ(seeded.regions.size(), 2U);
  for (const RegionSeed& seed : seeded.regions) EXPECT_EQ(seed.id, seed.where[0] < 1 ? 1 : 2);
  EXPECT_TRUE(seeded.holes.empty());
}

TEST(Seeds, LieInPartsThatAreThinnerThanALastBit) {
  const Point a{0x1.3ceb3ff2f6ea1p+0, 0x1.8b529b442c6c6p+0, 0x1.5eb561bd4f6b8p+0},
      b{0x1.9a9a80ef2b725p+0, 0x1.a02f34b296572p+0, 0x1.10c67fd361124p+0},
      c{0x1.035efa3d150a5p+0, 0x1.d6645faf03f38p+0, 0x1.42650651a0072p+0},
      middle{0x1.48f6e90a67ccfp+0, 0x1.ab4cba8c97925p+0, 0x1.3b4af7f61ad6fp+0};
  const Surface seeded =
      with_seeds(joined({tetrahedron({a, b, c, {2, 2, 2}}), tetrahedron({a, c, b, middle})}));
  ASSERT_EQ(seeded.regions.size(), 2U);
  Options options;
  options.regions = seeded.regions;
  options.sizes.reset();
  const Result result = mesh(seeded.view(), options);
  ASSERT_EQ(result.outcome, Outcome::done) << result.message;
  EXPECT_EQ(std::set<int>(result.volume.regions.begin(), result.volume.regions.end()), (std::set<int>{1, 2}));
}

}  // namespace
}  // namespace holdfast::seeds_test
