// Surfaces at the ends of the range of doubles, each known to have a mesh in doubles: every run finds one.
// HOLDFAST_NUMBER_RANGE=from,to meshes the surfaces with these numbers, and reports failures.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <sstream>

#include "holdfast/check.h"
#include "number_range_surfaces.h"

namespace holdfast::number_range_test {
namespace {

using number_range::Case;

std::string broken_rules(const Surface& surface, const Volume& volume) {
  std::string text;
  for (const Rule& rule : check(surface.view(), volume).rules)
    if (!rule.holds) text += rule.name + ": " + rule.detail + "; ";
  return text;
}

// The faults of a surface's meshes; empty if there are none.
std::string fault_of(const Case& task, bool flips) {
  Options options;
  options.flips = flips;
  const Result result = mesh(task.surface.view(), options);
  if (result.outcome != Outcome::done)
    return result.message + (result.defects.empty() ? "" : " " + result.defects[0].message);
  return broken_rules(task.surface, result.volume);
}

void expect_meshes(std::uint64_t from, std::uint64_t to) {
  for (std::uint64_t n = from; n < to; ++n) {
    const Case task = number_range::number(n);
    for (const bool flips : {true, false})
      EXPECT_EQ(fault_of(task, flips), "") << task.name << (flips ? "" : " without flips");
  }
}

TEST(NumberRange, SurfacesWithAMeshInDoublesGetOne) {
  std::uint64_t from = 0, to = 150;
  if (const char* range = std::getenv("HOLDFAST_NUMBER_RANGE")) {
    std::istringstream in(range);
    char comma = 0;
    in >> from >> comma >> to;
  }
  expect_meshes(from, to);
}

// Kernels that are thinner than an ulp and slanted: the doubles inside are not near the centre of any ball.
TEST(NumberRange, ShearedPrismFarFromTheOrigin) {
  for (const double twist : {20.0, 30.0, 40.0}) {
    Surface s = number_range::schoenhardt(6, 6, twist);
    ASSERT_TRUE(number_range::centre_on_integers(s).has_value()) << twist;
    for (Point& p : s.vertices) p = {p[0] + 10 * p[1], p[1] + 10 * p[2], p[2]};
    const double by = 0x1p52 + 0x1p20;
    number_range::move(s, {by, by, by});
    EXPECT_EQ(fault_of({"prism", s}, true), "") << twist;
    EXPECT_EQ(fault_of({"prism", s}, false), "") << twist;
  }
}

// 27 doubles lie inside.
TEST(NumberRange, CubeInLeastDoubles) {
  for (const int exponent : {0, -800, -1000, -1074}) {
    Surface s = number_range::cube(4);
    number_range::scale(s, exponent);
    EXPECT_EQ(fault_of({"cube", s}, true), "") << exponent;
  }
}

}  // namespace
}  // namespace holdfast::number_range_test
