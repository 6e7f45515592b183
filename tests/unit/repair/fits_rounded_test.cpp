// Whether the triangles of a sheet still fit together once its points are rounded.
#include "arrange/fits_rounded.h"

#include <gtest/gtest.h>

#include "arrange/flat_mesh.h"

namespace holdfast::arrange::fits_rounded_test {
namespace {

using exact::BigInt;
using exact::RationalPoint;

/// The triangle (0, 0), (1, 0), (0, 1) with some points more; `swapped`: its corners have other numbers.
bool fits(const std::vector<RationalPoint>& more, bool swapped) {
  plane::Points points;
  points.add(plane::Position{0, 0});
  points.add(swapped ? plane::Position{0, 1} : plane::Position{1, 0});
  points.add(swapped ? plane::Position{1, 0} : plane::Position{0, 1});
  FlatMesh mesh(points, 0, swapped ? 2 : 1, swapped ? 1 : 2);
  for (const RationalPoint& p : more) mesh.insert(points.add(p));
  return fits_rounded(mesh.triangles(), points);
}

RationalPoint rational(BigInt x, BigInt y, BigInt w) { return {std::move(x), std::move(y), std::move(w)}; }

TEST(FitsRounded, PointsThatStayApart) {
  for (const bool swapped : {false, true}) {
    EXPECT_TRUE(fits({}, swapped));
    EXPECT_TRUE(fits({rational(1, 1, 3)}, swapped));
    // On all three sides; thirds on the slanting one are not on it when they are rounded.
    EXPECT_TRUE(fits({rational(1, 0, 3), rational(0, 1, 3), rational(1, 2, 3), rational(2, 1, 3)}, swapped));
  }
}

TEST(FitsRounded, PointsThatRoundingPutsElsewhere) {
  const BigInt far = BigInt(1) << 1200;
  for (const bool swapped : {false, true}) {
    EXPECT_FALSE(fits({rational(far / 2, 1, far)}, swapped)) << "inside, and onto a side";
    EXPECT_FALSE(fits({rational(1, 1, far)}, swapped)) << "inside, and onto a corner";
    EXPECT_FALSE(fits({rational(far + 3, 0, 3 * far), rational(1, 0, 3)}, swapped))
        << "two on a side to one place";
    // One of them on the slanting side.
    const BigInt w = (BigInt(1) << 60) * 3;
    EXPECT_FALSE(fits({rational(w / 3, w - w / 3, w), rational(w / 3, w - w / 3 - 1, w)}, swapped))
        << "two to one place";
  }
}

/// By two doubles a coordinate as far as they suffice, by integers beyond.
TEST(Points, TurnsNextToALine) {
  for (unsigned j = 1; j < 300; ++j)
    for (const int s : {-1, 0, 1}) {
      plane::Points points;
      const plane::Vertex a = points.add(plane::Position{0, 0}), b = points.add(plane::Position{1, 1});
      const BigInt power = BigInt(1) << j;
      const plane::Vertex p = points.add(rational(power + 3 * s, power, 3 * power));
      EXPECT_EQ(points.orient(a, b, p), -s) << j;
      EXPECT_EQ(points.orient(p, b, a), s) << j;
    }
}

/// A point known to be on a side costs no arithmetic, and changes nothing.
TEST(FlatMesh, TakesPointsOnSidesAtTheirWord) {
  for (const bool told : {false, true}) {
    plane::Points points;
    for (const plane::Position& p : {plane::Position{0, 0}, plane::Position{1, 0}, plane::Position{0, 1}})
      points.add(p);
    FlatMesh mesh(points, 0, 1, 2);
    const plane::Vertex p = points.add(rational(2, 1, 3));
    mesh.insert(p, told ? 0b001 : 0);
    const plane::Vertex q = points.add(rational(1, 2, 3));
    mesh.insert(q, told ? 0b001 : 0);
    EXPECT_EQ(mesh.chain(1, 2), (std::vector<Vertex>{1, p, q, 2}));
    EXPECT_EQ(mesh.triangles().size(), 3u);
  }
}

}  // namespace
}  // namespace holdfast::arrange::fits_rounded_test
