// Random point sets in special position: every tetrahedron made on the way must be strictly positive, and the
// result must be Delaunay with respect to every vertex.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "delaunay/delaunay.h"
#include "delaunay/insert.h"
#include "delaunay/order.h"
#include "delaunay_checks.h"

namespace holdfast::delaunay_degenerate_test {
namespace {

using Random = std::mt19937_64;
using testing::delaunay_fault;
using testing::mesh_of;

int integer(Random& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}
double unit(Random& random) { return std::uniform_real_distribution<double>(-1, 1)(random); }

struct Family {
  const char* name;
  std::function<Point(Random&)> point;
  int most = 60;  // points of a small set: fewer if every exact decision needs big integers
};

Point jittered(Point p, Random& random) {
  for (double& x : p) {
    const int steps = integer(random, -1, 1);
    for (int i = 0; i < std::abs(steps); ++i)
      x = std::nextafter(
          x, steps > 0 ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity());
  }
  return p;
}

Point small_integers(Random& random) {
  return {static_cast<double>(integer(random, 0, 3)), static_cast<double>(integer(random, 0, 3)),
          static_cast<double>(integer(random, 0, 3))};
}

// Integer points on the sphere of radius 15: many cospherical quintuples, exactly.
Point on_sphere(Random& random) {
  for (;;) {
    const int x = integer(random, -15, 15), y = integer(random, -15, 15);
    const int z2 = 225 - x * x - y * y;
    if (z2 < 0) continue;
    const int z = static_cast<int>(std::lround(std::sqrt(z2)));
    if (z * z != z2) continue;
    return {static_cast<double>(x), static_cast<double>(y),
            static_cast<double>(integer(random, 0, 1) == 0 ? z : -z)};
  }
}

const std::vector<Family>& families() {
  static const std::vector<Family> all = {
      {"small integers", small_integers},
      {"small integers moved by an ulp",
       [](Random& random) {
         Point p = small_integers(random);
         for (double& x : p) x += 1;
         return jittered(p, random);
       }},
      {"tenths",
       [](Random& random) {
         Point p = small_integers(random);
         for (double& x : p) x *= 0.1;
         return p;
       }},
      {"sphere", on_sphere},
      {"sphere and centre",
       [](Random& random) {
         return integer(random, 0, 9) == 0 ? Point{0, 0, 0} : on_sphere(random);
       }},
      {"rounded sphere",
       [](Random& random) {
         const Point p = on_sphere(random);
         return Point{p[0] / 15, p[1] / 15, p[2] / 15};
       }},
      {"two skew lines",
       [](Random& random) {
         const double t = integer(random, -20, 20);
         return integer(random, 0, 1) == 0 ? Point{t, 0, 0} : Point{0, t, 1};
       }},
      {"three axes",
       [](Random& random) {
         Point p{0, 0, 0};
         p[static_cast<std::size_t>(integer(random, 0, 2))] = unit(random);
         return p;
       }},
      {"two parallel planes",
       [](Random& random) {
         return Point{static_cast<double>(integer(random, 0, 5)), static_cast<double>(integer(random, 0, 5)),
                      static_cast<double>(integer(random, 0, 1))};
       }},
      {"a plane and one point",
       [](Random& random) {
         if (integer(random, 0, 30) == 0) return Point{2, 2, 1};
         return Point{static_cast<double>(integer(random, 0, 6)), static_cast<double>(integer(random, 0, 6)),
                      0};
       }},
      {"a slanted plane of doubles and one point",
       [](Random& random) {
         if (integer(random, 0, 30) == 0) return Point{0.3, 0.1, 0.7};
         const double x = 0.1 * integer(random, 0, 7), y = 0.7 * integer(random, 0, 7);
         return Point{x, y, x};
       }},
      {"spiral",
       [](Random& random) {
         const double t = integer(random, 0, 200) * 0.05;
         return Point{t * std::cos(t), t * std::sin(t), t * t / 8};
       }},
      {"nested scales",
       [](Random& random) {
         Point p = small_integers(random);
         const double scale = std::ldexp(1.0, -40 * integer(random, 0, 25));
         for (double& x : p) x *= scale;
         return p;
       },
       20},
      {"ends of the range",
       [](Random& random) {
         Point p = small_integers(random);
         for (double& x : p) x = (x - 1.5) * std::ldexp(1.0, integer(random, 0, 1) == 0 ? 1022 : -1070);
         return p;
       },
       20},
      {"moment curve",
       [](Random& random) {
         const double t = integer(random, -30, 30);
         return Point{t, t * t, t * t * t};
       }},
  };
  return all;
}

std::vector<Point> sample(const Family& family, std::size_t n, Random& random) {
  std::vector<Point> points(n);
  for (Point& p : points) p = family.point(random);
  return points;
}

// Checks that no vertex is strictly inside any sphere.
std::string global_fault(const TetMesh& mesh) {
  for (Tet t = 0; t < mesh.slot_count(); ++t) {
    if (mesh.is_ghost(t)) continue;
    const auto& c = mesh.corners(t);
    for (Vertex v = 0; v < mesh.vertex_count(); ++v)
      if (exact::insphere(mesh.position(c[0]).data(), mesh.position(c[1]).data(), mesh.position(c[2]).data(),
                          mesh.position(c[3]).data(), mesh.position(v).data()) > 0)
        return "vertex " + std::to_string(v) + " in the sphere of " + std::to_string(t);
  }
  return {};
}

bool spans_space(const std::vector<Point>& points) {
  for (std::size_t b = 1; b < points.size(); ++b)
    for (std::size_t c = b + 1; c < points.size(); ++c)
      for (std::size_t d = c + 1; d < points.size(); ++d)
        if (exact::orient3d(points[0].data(), points[b].data(), points[c].data(), points[d].data()) != 0)
          return true;
  return false;
}

TEST(DelaunayDegenerate, EveryFamilyIsDelaunay) {
  Random random(2024);
  for (const Family& family : families()) {
    for (int round = 0; round < 25; ++round) {
      const auto n = static_cast<std::size_t>(integer(random, 1, family.most));
      const std::vector<Point> points = sample(family, n, random);
      TetMesh mesh = mesh_of(points);
      const bool made = build_delaunay(mesh, {random()}, nullptr);
      if (!made) {
        ASSERT_EQ(mesh.tet_count(), 0u);
        ASSERT_FALSE(spans_space(points)) << family.name;
        continue;
      }
      ASSERT_EQ(delaunay_fault(mesh), "") << family.name << ", round " << round;
      ASSERT_EQ(global_fault(mesh), "") << family.name << ", round " << round;
    }
  }
}

TEST(DelaunayDegenerate, LargerSets) {
  Random random(77);
  for (const Family& family : families()) {
    TetMesh mesh = mesh_of(sample(family, static_cast<std::size_t>(25 * family.most), random));
    ASSERT_TRUE(build_delaunay(mesh, {random()}, nullptr)) << family.name;
    ASSERT_EQ(delaunay_fault(mesh), "") << family.name;
  }
}

// The theorem at the head of triangulation.h: not only the final cells, but every cell that an insertion
// makes is strictly positive, in any order of insertion.
TEST(DelaunayDegenerate, NoFlatCellArisesOnTheWay) {
  Random random(5);
  for (const Family& family : families()) {
    for (int round = 0; round < 8; ++round) {
      const std::vector<Point> points = sample(family, 40, random);
      std::vector<std::uint32_t> order(points.size());
      std::iota(order.begin(), order.end(), 0u);
      std::shuffle(order.begin(), order.end(), random);
      Triangulation triangulation(points, {order, {order.size()}}, 1);
      if (!triangulation.start()) continue;
      Inserter inserter(triangulation, 0, random());
      for (std::size_t k = 4; k < triangulation.size(); ++k) {
        inserter.insert(static_cast<Vertex>(k));
        inserter.give_slots_back();
        for (const Cell& cell : triangulation.cells()) {
          if (std::signbit(cell.reach) || cell.v[3] == triangulation.ghost()) continue;
          const auto at = [&](std::size_t i) { return triangulation.at(cell.v[i]); };
          ASSERT_GT(exact::orient3d(at(0), at(1), at(2), at(3)), 0) << family.name << ", insertion " << k;
        }
      }
    }
  }
}

TEST(DelaunayDegenerate, OrderIsAPermutation) {
  Random random(8);
  for (const Family& family : families()) {
    for (const std::size_t n : {0u, 1u, 17u, 700u, 5000u}) {
      const std::vector<Point> points = sample(family, n, random);
      std::vector<std::uint32_t> order = insertion_order(points, 4).points;
      ASSERT_EQ(order, insertion_order(points, 4).points);
      ASSERT_EQ(order, insertion_order(points, 4, 3).points);
      std::sort(order.begin(), order.end());
      for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(order[i], i) << family.name;
      ASSERT_EQ(order.size(), n);
    }
  }
}

// The last of several cospherical vertices is joined to all others: one tetrahedron for each face of the hull
// of which it is no corner, instead of up to the square of that.
TEST(DelaunayDegenerate, OneOfManyCosphericalPointsIsACornerOfAllTetrahedra) {
  for (const int norm : {101, 402, 1001}) {
    std::vector<Point> points;
    for (int x = -40; x <= 40; ++x)
      for (int y = -40; y <= 40; ++y)
        for (int z = -40; z <= 40; ++z)
          if (x * x + y * y + z * z == norm) points.push_back({1.0 * x, 1.0 * y, 1.0 * z});
    ASSERT_GE(points.size(), 100u);
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const std::vector<Tetrahedron> tets = delaunay(points, seed);
      std::vector<std::size_t> uses(points.size(), 0);
      for (const Tetrahedron& t : tets)
        for (const Index v : t) ++uses[v];
      EXPECT_EQ(*std::max_element(uses.begin(), uses.end()), tets.size()) << norm;
    }
  }
}

}  // namespace
}  // namespace holdfast::delaunay_degenerate_test
