// Packed points are the same numbers as before.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "exact/packed_point.h"

namespace holdfast::exact::exact_packed_point_test {
namespace {

TEST(PackedPoint, KeepsEveryNumber) {
  const std::array<BigInt, 7> numbers{0,
                                      1,
                                      -1,
                                      (BigInt(1) << 64) - 1,
                                      -(BigInt(1) << 64),
                                      (BigInt(3) << 511) + 5,
                                      -(BigInt(7) << 12'000) - 1};
  for (const BigInt& x : numbers)
    for (const BigInt& y : numbers) {
      const SpacePoint p = PackedPoint({x, y, -x, BigInt(y * y + 1)}).point();
      EXPECT_EQ(p.x, x);
      EXPECT_EQ(p.y, y);
      EXPECT_EQ(p.z, BigInt(-x));
      EXPECT_EQ(p.w, BigInt(y * y + 1));
      EXPECT_EQ(p.x.sign(), x.sign());
    }
}

TEST(PackedPoint, KeepsCrossingsOfPlanes) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> in(-1, 1);
  const auto plane = [&] {
    std::array<std::array<double, 3>, 3> p{};
    for (auto& corner : p)
      for (double& x : corner) x = in(random);
    return plane_through(p[0].data(), p[1].data(), p[2].data());
  };
  for (int k = 0; k < 200; ++k) {
    const SpacePoint p = crossing(plane(), plane(), plane());
    const SpacePoint again = PackedPoint(p).point();
    EXPECT_TRUE(equal(p, again));
    EXPECT_EQ(nearest(p), nearest(again));
  }
}

}  // namespace
}  // namespace holdfast::exact::exact_packed_point_test
