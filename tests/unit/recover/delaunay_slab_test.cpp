// Inserters that work in slabs of space at the same time.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "delaunay/insert.h"

namespace holdfast::delaunay_slab_test {
namespace {

std::vector<Point> on_a_sphere(std::size_t n) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> coordinate(0, 1);
  std::vector<Point> points(n);
  for (Point& p : points) {
    for (double& x : p) x = coordinate(random);
    const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    p = {p[0] / length + 5, p[1] / length, p[2] / length};
  }
  return points;
}

// A walk that begins in a ghost may end there, and take a point for one that exists already.
TEST(Inserter, EntersASlabByAFiniteCellFromWhichAllOtherPointsAreFound) {
  const std::vector<Point> points = on_a_sphere(200);
  Triangulation triangulation(points, insertion_order(points, 1), 1);
  ASSERT_TRUE(triangulation.start());
  Inserter inserter(triangulation, 0, 1);
  for (Vertex k = 4; k < points.size(); ++k) {
    // Nearly all are beyond the hull.
    ASSERT_TRUE(inserter.enter(Slab{}, static_cast<Vertex>(points.size() - 1), inserter.last()));
    const Cell& cell = triangulation.cells()[inserter.last()];
    EXPECT_FALSE(triangulation.is_ghost(cell)) << k;
    inserter.insert(k);
    EXPECT_GT(triangulation.sites()[k].cells, 0u) << k;
  }
}

}  // namespace
}  // namespace holdfast::delaunay_slab_test
