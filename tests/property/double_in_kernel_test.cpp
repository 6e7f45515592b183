// Doubles in kernels: found whenever an exhaustive search finds one, in kernels that are thin, slanted, and
// anywhere among the powers of two.
#include "mesh/double_in_kernel.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "mesh/editor.h"
#include "mesh/kernel.h"
#include "mesh_fixtures.h"

namespace holdfast::double_in_kernel_test {
namespace {

using namespace testing;
using exact::Dyadic;
using exact::ExactPoint;
using Random = std::mt19937_64;

std::int64_t between(Random& random, std::int64_t low, std::int64_t high) {
  return low + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(high - low + 1));
}

// Faces oriented towards what they see, in a mesh without tetrahedra that has their corners.
struct Faces {
  TetMesh mesh;
  std::vector<FaceKey> faces;

  // The half-space n.(x - at) > 0; n is not zero.
  void add(const ExactPoint& at, const std::array<Dyadic, 3>& n) {
    std::size_t axis = 0;
    while (n[axis].sign() == 0) ++axis;
    const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
    // Two vectors with the product n[axis] n: (-n_i e_axis + n_axis e_i) x (-n_j e_axis + n_axis e_j).
    ExactPoint u = at, v = at;
    u.c[axis] -= n[i];
    u.c[i] += n[axis];
    v.c[axis] -= n[j];
    v.c[j] += n[axis];
    if (n[axis].sign() < 0) std::swap(u, v);
    faces.push_back(
        {MeshEditor(mesh).add_vertex(at), MeshEditor(mesh).add_vertex(u), MeshEditor(mesh).add_vertex(v)});
  }
  void add_box(const ExactPoint& low, const ExactPoint& high) {
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<Dyadic, 3> n;
      n[k] = 1;
      add(low, n);
      n[k] = -1;
      add(high, n);
    }
  }
  [[nodiscard]] bool holds(const Point& p) const { return kernel_of(mesh, faces).holds({p.data(), nullptr}); }
};

std::vector<double> doubles_between(const exact::DoubleGrid& grid, double low, double high) {
  std::vector<double> out;
  for (double x = grid.nearest(low); x <= high; x = grid.next(x, true)) out.push_back(x);
  return out;
}

// A few doubles around `middle`, `spacing` apart, and faces with large slanted normals near a point among
// them.
struct Trial {
  Faces faces;
  bool expected = false;
};

Trial trial_at(Random& random, const Point& middle, const Point& spacing, int grid) {
  Trial out;
  if (grid > exact::DoubleGrid::kLeastExponent) MeshEditor(out.faces.mesh).set_grid(exact::DoubleGrid(grid));
  ExactPoint low = exact::lift(middle.data()), high = low, near = low;
  std::array<std::vector<double>, 3> doubles;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto reach = static_cast<double>(between(random, 1, 5));
    low.c[k] -= Dyadic(spacing[k]) * Dyadic(reach);
    high.c[k] += Dyadic(spacing[k]) * Dyadic(reach);
    near.c[k] += Dyadic(spacing[k]) * Dyadic(exact::BigInt(between(random, -300, 300)), -7);
    doubles[k] = doubles_between(out.faces.mesh.grid(), low.c[k].to_double(), high.c[k].to_double());
  }
  out.faces.add_box(low, high);
  const std::int64_t count = between(random, 1, 7), steepest = between(random, 1, 40);
  for (std::int64_t f = 0; f < count; ++f) {
    std::array<Dyadic, 3> n;
    for (std::size_t k = 0; k < 3; ++k)
      n[k] = Dyadic(exact::BigInt(between(random, -steepest, steepest)), 0) * Dyadic(spacing[(k + 1) % 3]) *
             Dyadic(spacing[(k + 2) % 3]);
    if (n[0].sign() == 0 && n[1].sign() == 0 && n[2].sign() == 0) continue;
    ExactPoint at = near;
    at.c[random() % 3] += Dyadic(spacing[0]) * Dyadic(exact::BigInt(between(random, -9, 9)), -8);
    out.faces.add(at, n);
  }
  for (const double x : doubles[0])
    for (const double y : doubles[1])
      for (const double z : doubles[2]) out.expected = out.expected || out.faces.holds({x, y, z});
  return out;
}

void expect_complete(Random& random, const std::function<std::pair<Point, Point>()>& place, int grid,
                     int trials) {
  int empty = 0, found = 0;
  for (int k = 0; k < trials; ++k) {
    const auto [middle, spacing] = place();
    const Trial trial = trial_at(random, middle, spacing, grid);
    const DoubleSearch search = find_double(trial.faces.mesh, trial.faces.faces);
    ASSERT_TRUE(search.is_complete) << k;
    ASSERT_EQ(search.point.has_value(), trial.expected) << k;
    if (search.point) {
      EXPECT_TRUE(trial.faces.holds(*search.point)) << k;
      EXPECT_EQ(trial.faces.mesh.on_grid(*search.point), *search.point) << k;
    }
    ++(search.point ? found : empty);
  }
  EXPECT_GT(empty, trials / 10);
  EXPECT_GT(found, trials / 10);
}

TEST(DoubleInKernel, InsideOneBinade) {
  Random random(1);
  const auto place = [&] {
    Point middle{}, spacing{};
    for (std::size_t k = 0; k < 3; ++k) {
      const int exponent = static_cast<int>(between(random, -4, 4));
      middle[k] =
          std::ldexp(static_cast<double>(0x1'8000'0000'0000 + between(random, 0, 1 << 20)), exponent + 4);
      middle[k] *= between(random, 0, 1) == 0 ? 1 : -1;
      spacing[k] = std::ldexp(1.0, exponent);
    }
    return std::pair{middle, spacing};
  };
  expect_complete(random, place, exact::DoubleGrid::kLeastExponent, 150);
}

TEST(DoubleInKernel, AcrossPowersOfTwo) {
  Random random(2);
  const auto place = [&] {
    Point middle{}, spacing{};
    for (std::size_t k = 0; k < 3; ++k) {
      const int exponent = static_cast<int>(between(random, -3, 3));
      middle[k] = std::ldexp(between(random, 0, 1) == 0 ? 1.0 : -1.0, exponent + 53);
      spacing[k] = std::ldexp(1.0, exponent);
    }
    return std::pair{middle, spacing};
  };
  expect_complete(random, place, exact::DoubleGrid::kLeastExponent, 150);
}

TEST(DoubleInKernel, AmongTheDenormalsAndOnAGridRoundZero) {
  Random random(3);
  const auto denormals = [&] {
    return std::pair{Point{std::ldexp(static_cast<double>(between(random, -9, 9)), -1074), 0, 0},
                     Point{0x1p-1074, 0x1p-1074, 0x1p-1074}};
  };
  expect_complete(random, denormals, exact::DoubleGrid::kLeastExponent, 100);
  const auto grid = [&] {
    return std::pair{Point{static_cast<double>(between(random, -9, 9)) / 4, 0, 0}, Point{0.25, 0.25, 0.25}};
  };
  expect_complete(random, grid, -2, 100);
}

// All doubles from -1 to 1, for which a search one by one would not end.
TEST(DoubleInKernel, RoundZero) {
  const auto slab = [](const Dyadic& from, const Dyadic& to, const std::array<Dyadic, 3>& n) {
    Faces out;
    out.add_box({{-1, -1, -1}}, {{1, 1, 1}});
    ExactPoint low, high;
    low.c[2] = from;
    high.c[2] = to;
    out.add(low, n);
    out.add(high, {-n[0], -n[1], -n[2]});
    return out;
  };
  const Dyadic ulp = Dyadic(1).scaled(-52), third = Dyadic(0x1.5555555555555p-2);
  const std::array<Dyadic, 3> up{0, 0, 1}, slanted{third * Dyadic(0x1p-3), third * Dyadic(0x1p-4), 1};
  const Faces none = slab(Dyadic(0.5), Dyadic(0.5) + ulp.scaled(-1), up);
  const DoubleSearch empty = find_double(none.mesh, none.faces);
  EXPECT_FALSE(empty.point.has_value());
  EXPECT_TRUE(empty.is_complete);
  const Faces one = slab(Dyadic(0.5) - ulp.scaled(-3), Dyadic(0.5) + ulp.scaled(-3), up);
  EXPECT_TRUE(find_double(one.mesh, one.faces).point.has_value());
  for (const int thinner : {0, 8, 20, 40}) {
    const Dyadic from = Dyadic(0.5) + third * ulp;
    const Faces thin = slab(from, from + ulp.scaled(-thinner), slanted);
    const DoubleSearch found = find_double(thin.mesh, thin.faces);
    EXPECT_TRUE(found.point.has_value()) << thinner;
  }
}

// At the far ends: nothing beyond the greatest double, and that double itself.
TEST(DoubleInKernel, AtTheGreatestDouble) {
  const double most = std::numeric_limits<double>::max();
  const ExactPoint at{{Dyadic(most), Dyadic(most), Dyadic(most)}};
  const Dyadic ulp = Dyadic(1).scaled(971);
  Faces beyond;
  beyond.add_box(at, {{at.c[0] + ulp, at.c[1] + ulp, at.c[2] + ulp}});
  EXPECT_FALSE(find_double(beyond.mesh, beyond.faces).point.has_value());
  Faces round;
  round.add_box({{at.c[0] - ulp.scaled(-1), at.c[1] - ulp.scaled(-1), at.c[2] - ulp.scaled(-1)}},
                {{at.c[0] + ulp, at.c[1] + ulp, at.c[2] + ulp}});
  EXPECT_EQ(find_double(round.mesh, round.faces).point, (Point{most, most, most}));
}

}  // namespace
}  // namespace holdfast::double_in_kernel_test
