// Sides that several sheets route through their own vertices.
#include "repair/shared_sides.h"

#include <gtest/gtest.h>

namespace holdfast::repairing::shared_sides_test {
namespace {

using Indices = std::vector<Index>;

/// A side from vertex 0 to vertex 1 along x, and a vertex aside; others are added.
struct SharedSide {
  std::vector<Point> vertices{{0, 0, 0}, {10, 0, 0}, {5, 5, 0}};
  SharedSides sides{vertices, 0x1p-10};

  Index put(double x, double y = 0) {
    vertices.push_back({x, y, 0});
    return static_cast<Index>(vertices.size() - 1);
  }
};

TEST(SharedSides, ChainsFollowEachOtherAlongTheSide) {
  SharedSide on;
  const Index a = on.put(2), b = on.put(6), c = on.put(4), d = on.put(8);
  on.sides.add(0, 1, Indices{a, b});
  EXPECT_TRUE(on.sides.fits(1, 0, Indices{d, c}));
  on.sides.add(1, 0, Indices{d, c});
  ASSERT_TRUE(on.sides.finish());
  EXPECT_EQ(on.sides.chain(0, 1), (Indices{a, c, b, d}));
  EXPECT_EQ(on.sides.chain(1, 0), (Indices{d, b, c, a}));
  EXPECT_EQ(on.sides.chain(a, b), Indices{c});
  EXPECT_EQ(on.sides.chain(d, c), Indices{b});
  EXPECT_TRUE(on.sides.chain(0, a).empty());
  EXPECT_FALSE(on.sides.has_united());
}

TEST(SharedSides, NearVerticesAreMerged) {
  SharedSide on;
  const Index a = on.put(2), b = on.put(2 + 0x1p-12), c = on.put(7);
  on.sides.add(0, 1, Indices{a});
  on.sides.add(0, 1, Indices{b, c});
  ASSERT_TRUE(on.sides.finish());
  EXPECT_EQ(on.sides.root(b), a);
  EXPECT_GE(on.sides.most(), 0x1p-12);
  EXPECT_EQ(on.sides.chain(0, 1), (Indices{a, c}));
  EXPECT_EQ(on.sides.chain(a, 1), Indices{c});
}

/// Two sides along each other have common parts, where only one of them is routed further.
TEST(SharedSides, PartsOfSeveralSides) {
  SharedSide on;
  const Index a = on.put(2), b = on.put(6), c = on.put(4);
  const Index end = on.put(10, 1);
  on.sides.add(0, 1, Indices{a, b});
  on.sides.add(0, end, Indices{a, b});
  on.sides.add(0, 1, Indices{c});
  ASSERT_TRUE(on.sides.finish());
  EXPECT_EQ(on.sides.chain(a, b), Indices{c});
  EXPECT_EQ(on.sides.chain(0, end), (Indices{a, c, b}));
}

TEST(SharedSides, OrdersThatContradictEachOther) {
  SharedSide on;
  const Index a = on.put(2), b = on.put(6);
  on.sides.add(0, 1, Indices{a, b});
  EXPECT_FALSE(on.sides.fits(0, 1, Indices{b, a}));
  on.sides.add(0, 1, Indices{b, a});
  EXPECT_FALSE(on.sides.finish());
}

TEST(SharedSides, AChainThatIsAPartOfItself) {
  SharedSide on;
  const Index a = on.put(2), b = on.put(6);
  on.sides.add(a, b, Indices{0});
  on.sides.add(0, a, Indices{b});
  EXPECT_FALSE(on.sides.finish());
}

}  // namespace
}  // namespace holdfast::repairing::shared_sides_test
