// More effort, and field points, make no figure of a mesh worse (optimise/figures.h, api/without_field.h).
#include "optimise/figures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <ostream>
#include <string>

#include "hard_surfaces.h"
#include "holdfast/holdfast.h"
#include "mesh/quality.h"
#include "small_surfaces.h"

namespace holdfast::figures_test {
namespace {

// Measured in other ways than by Figures.
struct Measured {
  double least = 180, share_below = 0, mean_q = 0;
};

Measured measure_of(const Volume& volume) {
  Measured m;
  for (const Tetrahedron& t : volume.tetrahedra) {
    const auto& v = volume.vertices;
    const auto angles = dihedral_angles(v[t[0]], v[t[1]], v[t[2]], v[t[3]]);
    const double least = *std::min_element(angles.begin(), angles.end());
    m.least = std::min(m.least, least);
    if (least < 10 - 1e-6) m.share_below += 1;
    m.mean_q += quality(v[t[0]], v[t[1]], v[t[2]], v[t[3]]);
  }
  const auto count = static_cast<double>(volume.tetrahedra.size());
  m.share_below /= count;
  m.mean_q /= count;
  return m;
}

struct Family {
  const char* name;
  std::function<Surface(hard::Random&)> make;
  int count;
  Keep keep = Keep::automatic;
  std::uint64_t first_seed = 11;
};
std::ostream& operator<<(std::ostream& out, const Family& family) { return out << family.name; }

Surface fan(hard::Random& random) {
  Surface surface;
  const int n = hard::integer(random, 8, 40);
  for (const double z : {0.0, hard::uniform(random, 0.05, 2.0)})
    for (int k = 0; k < n; ++k)
      surface.vertices.push_back({std::cos(2 * hard::kPi * k / n),
                                  hard::uniform(random, 0.9, 1) * std::sin(2 * hard::kPi * k / n), z});
  const auto index = [](int i) { return static_cast<Index>(i); };
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    surface.facets.push_back({index(k), index(next), index(n + next)});
    surface.facets.push_back({index(k), index(n + next), index(n + k)});
  }
  for (int k = 1; k + 1 < n; ++k) {
    surface.facets.push_back({0, index(k + 1), index(k)});
    surface.facets.push_back({index(n), index(n + k), index(n + k + 1)});
  }
  return surface;
}

/// Two slanted cones on a common ring.
Surface double_cone(hard::Random& random) {
  Surface surface;
  const int n = hard::integer(random, 8, 48);
  const double radius = hard::log_uniform(random, 0.05, 10);
  const auto apex = [&](double side) {
    const double x = hard::uniform(random, -0.3, 0.3), y = hard::uniform(random, -0.3, 0.3);
    return Point{radius * x, radius * y, side * hard::log_uniform(random, 0.001, 10)};
  };
  for (int k = 0; k < n; ++k)
    surface.vertices.push_back(
        {radius * std::cos(2 * hard::kPi * k / n), radius * std::sin(2 * hard::kPi * k / n), 0});
  surface.vertices.push_back(apex(-1));
  surface.vertices.push_back(apex(1));
  for (int k = 0; k < n; ++k) {
    const auto from = static_cast<Index>(k), to = static_cast<Index>((k + 1) % n);
    surface.facets.push_back({static_cast<Index>(n), to, from});
    surface.facets.push_back({static_cast<Index>(n + 1), from, to});
  }
  return surface;
}

class FiguresOf : public ::testing::TestWithParam<Family> {};

TEST_P(FiguresOf, NeverGetWorse) {
  for (int k = 0; k < GetParam().count; ++k) {
    hard::Random random(GetParam().first_seed + static_cast<std::uint64_t>(k));
    const Surface surface = GetParam().make(random);
    for (const double size : {0.0, 0.3}) {
      Options options;
      options.keep = GetParam().keep;
      std::vector<Measured> meshes;
      if (size == 0) meshes.push_back(measure_of(mesh(surface.view(), options).volume));
      options.sizes = Sizes{.size = size};
      for (const Effort effort : {Effort::fast, Effort::good, Effort::best}) {
        options.effort = effort;
        const Result result = mesh(surface.view(), options);
        ASSERT_EQ(result.outcome, Outcome::done) << k;
        meshes.push_back(measure_of(result.volume));
      }
      for (std::size_t i = 1; i < meshes.size(); ++i) {
        EXPECT_GE(meshes[i].least, meshes[i - 1].least * (1 - 1e-9)) << k << ", size " << size << ", " << i;
        EXPECT_LE(meshes[i].share_below, meshes[i - 1].share_below) << k << ", size " << size << ", " << i;
        EXPECT_LE(meshes[i].mean_q, meshes[i - 1].mean_q * (1 + 1e-8)) << k << ", size " << size << ", " << i;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Surfaces, FiguresOf,
    ::testing::Values(Family{"fans", fan, 6},
                      // other orders are tried for all of these meshes, or for none
                      Family{"double_cones", double_cone, 2, Keep::automatic, 139},
                      Family{"double_cones_without_field", double_cone, 2, Keep::automatic, 532},
                      Family{"twisted_prisms", hard::twisted_prism, 4},
                      Family{"boxes", [](hard::Random&) { return small::box(); }, 1},
                      Family{"voxels", hard::voxels, 2}, Family{"spikes", hard::spikes, 1},
                      Family{"lattices", hard::lattice, 2, Keep::bounded},
                      Family{"scattered", hard::scattered, 2}),
    [](const auto& info) { return std::string(info.param.name); });

// Without field points, runs with different seeds end with similar worst elements: if they are bad, the same
// other orders are tried.
TEST(OtherChoices, SeedsAgree) {
  int apart = 0, tried = 0;
  for (int k = 0; k < 12; ++k) {
    hard::Random random(static_cast<std::uint64_t>(k) + 3);
    const Surface surface = k % 2 == 0 ? fan(random) : hard::twisted_prism(random);
    double best = std::numeric_limits<double>::infinity(), worst = 0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      Options options;
      options.seed = seed;
      const Result result = mesh(surface.view(), options);
      ASSERT_EQ(result.outcome, Outcome::done);
      best = std::min(best, result.report.elements.worst);
      worst = std::max(worst, result.report.elements.worst);
    }
    ++tried;
    if (worst > 2 * best) ++apart;
  }
  EXPECT_EQ(tried, 12);
  EXPECT_LE(apart, 1);
}

const Point kO{0, 0, 0}, kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1}, kLow{0.3, 0.3, 0.05};

TEST(Standard, RefusesWhatLowersTheLeastAngle) {
  Figures whole, good, bad;
  good.add(kO, kX, kY, kZ);
  bad.add(kO, kX, kY, kLow);
  whole.add(good);
  Standard standard(whole);
  EXPECT_FALSE(standard.allows(good, bad));
  EXPECT_TRUE(standard.allows(good, good));
}

// A figure that has improved may get worse again, but not worse than at first.
TEST(Standard, AllowsWhatGainsPayFor) {
  Figures whole, good, bad;
  good.add(kO, kX, kY, kZ);
  bad.add(kO, kX, kY, kLow);
  for (int k = 0; k < 3; ++k) whole.add(k < 2 ? bad : good);
  Standard standard(whole);
  EXPECT_FALSE(standard.allows(good, bad));
  EXPECT_TRUE(standard.allows(bad, good));
  EXPECT_TRUE(standard.allows(bad, good));
  EXPECT_TRUE(standard.allows(good, bad));
  EXPECT_FALSE(standard.allows(good, bad));  // equal, except for rounding
}

TEST(Figures, AnAngleOfTenDegreesIsNotBelow) {
  const double t = std::tan(10 * hard::kPi / 180);
  // A wedge of 10 degrees at the x axis, and of a little less.
  Figures wedge, thinner;
  wedge.add(kO, kX, {0.5, 1, 0}, {0.5, 1, t});
  thinner.add(kO, kX, {0.5, 1, 0}, {0.5, 1, 0.999 * t});
  EXPECT_EQ(wedge.below_10_deg(), 0u);
  EXPECT_EQ(thinner.below_10_deg(), 1u);
}

}  // namespace
}  // namespace holdfast::figures_test
