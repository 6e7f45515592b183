// The promise of docs/concepts.md on random complexes: through the public API, checked by the independent
// check.
//
// HOLDFAST_SEEDS=k takes k times as many complexes of each family.
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <ostream>
#include <string>

#include "dangling_surfaces.h"
#include "hard_surfaces.h"
#include "holdfast/check.h"
#include "holdfast/holdfast.h"

namespace holdfast::promise_test {
namespace {

struct Family {
  const char* name;
  std::function<Surface(hard::Random&, int)> make;  // the second: number of the complex in its family
  int count;
  Keep keep = Keep::automatic;
};

std::ostream& operator<<(std::ostream& out, const Family& family) { return out << family.name; }

template <Surface (*make)(hard::Random&)>
Surface random_one(hard::Random& random, int) {
  return make(random);
}

const Family kFamilies[] = {
    {"stars", random_one<hard::star>, 8},
    {"spikes", random_one<hard::spikes>, 4},
    {"twisted_prisms", random_one<hard::twisted_prism>, 20},
    {"sheets_over_floors", random_one<hard::sheet_over_floor>, 6},
    {"nested_spheres", random_one<hard::nested_spheres>, 6},
    {"voxels", random_one<hard::voxels>, 10},
    {"combs", random_one<hard::comb>, 4},
    {"lattices", random_one<hard::lattice>, 12, Keep::bounded},
    {"scattered", random_one<hard::scattered>, 6},
    {"furnished", random_one<hard::furnished>, 10, Keep::box},
    {"pencils", random_one<hard::pencil>, 6},
    {"bands", random_one<hard::band>, 8},
    {"chazelle", [](hard::Random&, int k) { return hard::chazelle(1 + k % 3); }, 3, Keep::bounded},
};

int seed_factor() {
  const char* const text = std::getenv("HOLDFAST_SEEDS");
  return text == nullptr ? 1 : std::max(1, std::atoi(text));
}

std::string broken_rules(const Surface& surface, const Volume& volume, bool box) {
  CheckOptions options;
  options.box = box;
  std::string text;
  for (const Rule& rule : check(surface.view(), volume, options).rules)
    if (!rule.holds) text += rule.name + ": " + rule.detail + "\n";
  return text;
}

class Promise : public ::testing::TestWithParam<std::tuple<Family, bool>> {};

TEST_P(Promise, IsKept) {
  const auto& [family, flips] = GetParam();
  const int runs = family.count * seed_factor();
  int without_doubles = 0;
  for (int k = 0; k < runs; ++k) {
    hard::Random random(static_cast<std::uint64_t>(k) + 1);
    const Surface surface = family.make(random, k);
    Options options;
    options.flips = flips;
    options.keep = family.keep;
    options.seed = static_cast<std::uint64_t>(k) + 1;
    Result result;
    ASSERT_NO_THROW(result = mesh(surface.view(), options)) << k;
    if (!flips && result.outcome == Outcome::not_representable) {
      ++without_doubles;
      continue;
    }
    ASSERT_EQ(result.outcome, Outcome::done)
        << k << ": " << result.message << (result.defects.empty() ? "" : " " + result.defects[0].message);
    EXPECT_EQ(broken_rules(surface, result.volume, family.keep == Keep::box), "") << k;
    EXPECT_EQ(result.report.unrounded_points, 0u) << k;
  }
  // An honest "not in doubles" may occur rarely if flips do not help.
  EXPECT_LE(20 * without_doubles, runs) << without_doubles << " of " << runs;
}

INSTANTIATE_TEST_SUITE_P(RandomComplexes, Promise,
                         ::testing::Combine(::testing::ValuesIn(kFamilies), ::testing::Bool()),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param).name) +
                                  (std::get<1>(info.param) ? "" : "_without_flips");
                         });

}  // namespace
}  // namespace holdfast::promise_test
