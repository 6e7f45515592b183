// Integer points of polytopes: found whenever an exhaustive search finds one, and never elsewhere, even if
// the polytope is long, slanted and thinner than the lattice.
#include "exact/integer_point.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace holdfast::exact::integer_point_test {
namespace {

using Random = std::mt19937_64;
using Small = std::array<long, 3>;

struct Problem {
  int dimension;
  long reach;  // of the box
  std::vector<IntegerHalfSpace> half_spaces;
};

long between(Random& random, long low, long high) {
  return std::uniform_int_distribution<long>(low, high)(random);
}

// Half-spaces whose borders pass near a point of the box, at heights that are not integers.
Problem random_problem(Random& random, int dimension) {
  Problem out{dimension, between(random, 1, 6), {}};
  const long denominator = between(random, 1, 12);
  Small near{};
  for (int k = 0; k < dimension; ++k)
    near[static_cast<std::size_t>(k)] = between(random, -out.reach * denominator, out.reach * denominator);
  const long faces = between(random, 1, 9), steepest = between(random, 1, 60);
  for (long f = 0; f < faces; ++f) {
    IntegerHalfSpace h{};
    BigInt at = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) {
      const long a = between(random, -steepest, steepest);
      h.a[k] = a * denominator;
      at += BigInt(a) * near[k];
    }
    h.b = at + between(random, -steepest, 2 * steepest);
    out.half_spaces.push_back(h);
  }
  return out;
}

bool holds(const IntegerHalfSpace& h, const IntegerVector& x) {
  return h.a[0] * x[0] + h.a[1] * x[1] + h.a[2] * x[2] <= h.b;
}
bool holds(const std::vector<IntegerHalfSpace>& half_spaces, const IntegerVector& x) {
  for (const IntegerHalfSpace& h : half_spaces)
    if (!holds(h, x)) return false;
  return true;
}

bool exhaustive(const Problem& problem) {
  const auto reach = [&](int axis) { return axis < problem.dimension ? problem.reach : 0; };
  for (long x = -reach(0); x <= reach(0); ++x)
    for (long y = -reach(1); y <= reach(1); ++y)
      for (long z = -reach(2); z <= reach(2); ++z)
        if (holds(problem.half_spaces, {x, y, z})) return true;
  return false;
}

// The box as half-spaces, so that it can be sheared.
std::vector<IntegerHalfSpace> with_box(const Problem& problem) {
  std::vector<IntegerHalfSpace> out = problem.half_spaces;
  for (std::size_t k = 0; k < static_cast<std::size_t>(problem.dimension); ++k)
    for (const int sign : {-1, 1}) {
      IntegerHalfSpace side{};
      side.a[k] = sign;
      side.b = problem.reach;
      out.push_back(side);
    }
  return out;
}

// x = M y for a unimodular M: every integer x has an integer y.
std::vector<IntegerHalfSpace> sheared(std::vector<IntegerHalfSpace> half_spaces, int dimension,
                                      Random& random) {
  const auto d = static_cast<std::size_t>(dimension);
  const long most = 1L << between(random, 1, 12);
  for (int step = 0; step < 6 && d > 1; ++step) {
    const std::size_t i = random() % d, j = (i + 1 + random() % (d - 1)) % d;
    const long times = between(random, -most, most);
    for (IntegerHalfSpace& h : half_spaces) h.a[i] += times * h.a[j];
  }
  return half_spaces;
}

TEST(IntegerPoint, IsFoundWhereThereIsOne) {
  Random random(1);
  int empty = 0, found = 0;
  for (int trial = 0; trial < 6000; ++trial) {
    const int dimension = 1 + trial % 3;
    const Problem problem = random_problem(random, dimension);
    const std::vector<BigInt> low(3, -problem.reach), high(3, problem.reach);
    const IntegerPointSearch search = find_integer_point(dimension, low, high, problem.half_spaces);
    ASSERT_TRUE(search.is_complete) << trial;
    ASSERT_EQ(search.point.has_value(), exhaustive(problem)) << "trial " << trial;
    ASSERT_TRUE(!search.point || holds(with_box(problem), *search.point)) << trial;
    ++(search.point ? found : empty);
  }
  EXPECT_GT(empty, 1000);
  EXPECT_GT(found, 1000);
}

TEST(IntegerPoint, IsFoundInWhatIsLongAndSlanted) {
  Random random(2);
  int empty = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const int dimension = 2 + trial % 2;
    const Problem problem = random_problem(random, dimension);
    const std::vector<IntegerHalfSpace> faces = sheared(with_box(problem), dimension, random);
    const std::vector<BigInt> low(3, -(BigInt(1) << 90)), high(3, BigInt(1) << 90);
    const IntegerPointSearch search = find_integer_point(dimension, low, high, faces, 200);
    ASSERT_TRUE(search.is_complete) << trial;
    ASSERT_EQ(search.point.has_value(), exhaustive(problem)) << "trial " << trial;
    ASSERT_TRUE(!search.point || holds(faces, *search.point)) << trial;
    empty += search.point ? 0 : 1;
  }
  EXPECT_GT(empty, 500);
}

// Thinner than the lattice by 2^40, through one lattice point or next to it.
TEST(IntegerPoint, OfANeedle) {
  Random random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const IntegerVector through{random() >> 14, random() >> 14, random() >> 14};
    std::vector<IntegerHalfSpace> faces;
    for (int f = 0; f < 8; ++f) {
      IntegerHalfSpace h{};
      BigInt at = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        h.a[k] = BigInt(static_cast<std::int64_t>(random()) >> 20);
        at += h.a[k] * through[k];
      }
      h.b = at - (trial % 2 == 0 ? 0 : 1);
      faces.push_back(h);
    }
    const std::vector<BigInt> low{through[0] - 1, through[1] - 1, through[2] - 1},
        high{through[0] + 1, through[1] + 1, through[2] + 1};
    bool expected = false;
    for (int code = 0; code < 27; ++code)
      expected = expected || holds(faces, {through[0] + code % 3 - 1, through[1] + code / 3 % 3 - 1,
                                           through[2] + code / 9 - 1});
    const IntegerPointSearch search = find_integer_point(3, low, high, faces);
    ASSERT_TRUE(search.is_complete);
    EXPECT_EQ(search.point.has_value(), expected) << trial;
  }
}

}  // namespace
}  // namespace holdfast::exact::integer_point_test
