// The promise of docs/concepts.md with field points: random complexes, judged by the independent check.
#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <string>

#include "dangling_surfaces.h"
#include "hard_surfaces.h"
#include "holdfast/check.h"
#include "holdfast/holdfast.h"

namespace holdfast::field_promise_test {
namespace {

struct Family {
  const char* name;
  std::function<Surface(hard::Random&)> make;
  int count;
  double size;  // the largest; 0: that of the surface
  Keep keep = Keep::automatic;
};

std::ostream& operator<<(std::ostream& out, const Family& family) { return out << family.name; }

const Family kFamilies[] = {
    {"stars", hard::star, 4, 0.2},
    {"spikes", hard::spikes, 3, 0.4},
    {"twisted_prisms", hard::twisted_prism, 8, 0.3},
    {"nested_spheres", hard::nested_spheres, 3, 0.3},
    {"voxels", hard::voxels, 4, 0.5},
    {"combs", hard::comb, 2, 0},
    {"lattices", hard::lattice, 4, 0.1, Keep::bounded},
    {"scattered", hard::scattered, 3, 0.2},
    {"furnished", hard::furnished, 6, 0.2, Keep::box},
    {"pencils", hard::pencil, 4, 0.3},
    {"bands", hard::band, 4, 0.3},
};

class FieldPromise : public ::testing::TestWithParam<Family> {};

TEST_P(FieldPromise, IsKept) {
  const Family& family = GetParam();
  std::size_t points = 0;
  for (int k = 0; k < family.count; ++k) {
    hard::Random random(static_cast<std::uint64_t>(k) + 1);
    const Surface surface = family.make(random);
    Options options;
    options.keep = family.keep;
    options.sizes = Sizes{.size = family.size};
    options.effort = k % 2 == 0 ? Effort::good : Effort::fast;
    Result result;
    ASSERT_NO_THROW(result = mesh(surface.view(), options)) << k;
    ASSERT_EQ(result.outcome, Outcome::done) << k << ": " << result.message;
    CheckOptions check_options;
    check_options.box = family.keep == Keep::box;
    for (const Rule& rule : check(surface.view(), result.volume, check_options).rules)
      EXPECT_TRUE(rule.holds) << k << ": " << rule.name << ": " << rule.detail;
    points += result.report.field.points;
  }
  EXPECT_GT(points, 0u);
}

INSTANTIATE_TEST_SUITE_P(RandomComplexes, FieldPromise, ::testing::ValuesIn(kFamilies),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace holdfast::field_promise_test
