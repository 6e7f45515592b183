// Sheets that coincide up to rounding.
#include "repair/flatten.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "numbers/random.h"
#include "repair/ladder.h"
#include "small_surfaces.h"

namespace holdfast::repairing::flatten_test {
namespace {

const Step kNoStep = [](double) {};
constexpr double kGap = 0x1p-44;

Rounded rounded_in_plane(State plane, double most) {
  const RepairOptions options;
  ExactSurface exact;
  RoundedPlanes planes;
  const Parents none;
  const Threads one = 1;
  return Ladder(std::move(plane), options, {}, {exact, none}, planes, kNoStep, one).run_in_plane(most);
}

/// Boxes beside and on each other, whose corners are some last bits off.
State boxes(std::size_t count, numbers::Random& random) {
  std::vector<Point> vertices;
  std::vector<Triangle> facets;
  for (std::size_t k = 0; k < count; ++k) {
    const auto first = static_cast<Index>(vertices.size());
    Point low{}, high{};
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = static_cast<double>(numbers::below(4, random)) / 3;
      high[i] = low[i] + static_cast<double>(1 + numbers::below(3, random)) / 3;
    }
    for (std::size_t v = 0; v < 8; ++v) {
      Point& p = vertices.emplace_back();
      for (std::size_t i = 0; i < 3; ++i)
        p[i] = (v >> i & 1u ? high : low)[i] + static_cast<double>(numbers::below(9, random)) * 0x1p-50;
    }
    for (const Triangle& t : small::kSidesOfBox) facets.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return state_of({vertices, facets, {}, {}, {}});
}

TEST(Flatten, ToTheEndIsTheSameAsAgainAndAgain) {
  numbers::Random random(7);
  std::size_t several = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const State given = boxes(2 + trial % 6, random);
    for (const SidesOf sides : {SidesOf::all_sheets, SidesOf::one_sheet}) {
      State state = given, same = given;
      const Flattened all = flatten_all(state, kGap, rounded_in_plane, sides, kNoStep);
      std::size_t passes = 0;
      for (; passes < 4 && flatten(same, kGap, rounded_in_plane, sides, kNoStep).moved > 0; ++passes) {
      }
      several += passes > 1 ? 1 : 0;
      EXPECT_EQ(all.moved > 0, passes > 0);
      EXPECT_EQ(state.vertices, same.vertices);
      EXPECT_EQ(state.facets, same.facets);
      EXPECT_EQ(state.facet_parents.all, same.facet_parents.all);
    }
  }
  EXPECT_GT(several, 10u);
}

TEST(Flatten, WhereSheetsShareNoLedSideAllDoWhatOneDoes) {
  numbers::Random random(8);
  std::size_t not_shared = 0, shared = 0, led_alone = 0;
  for (int trial = 0; trial < 60; ++trial) {
    State together = boxes(2, random), one_by_one = together;
    const std::size_t vertices = together.vertices.size();
    const bool has_shared =
        flatten_all(together, kGap, rounded_in_plane, SidesOf::all_sheets, kNoStep).has_shared;
    flatten_all(one_by_one, kGap, rounded_in_plane, SidesOf::one_sheet, kNoStep);
    (has_shared ? shared : not_shared) += 1;
    if (has_shared) continue;
    led_alone += together.vertices.size() > vertices ? 1 : 0;  // where sides cross
    EXPECT_EQ(together.vertices, one_by_one.vertices);
    EXPECT_EQ(together.facets, one_by_one.facets);
  }
  EXPECT_GT(not_shared, 10u);
  EXPECT_GT(led_alone, 3u);
  EXPECT_GT(shared, 10u);
}

/// A fan around an apex in a rotated plane. Each facet is a twentieth larger than the fan needs, and is
/// rounded separately.
State overlapping_fan(int facets) {
  const Point u{2.0 / 3, 1.0 / 3, 2.0 / 3}, v{-1.0 / 3, -2.0 / 3, 2.0 / 3};
  std::vector<Point> vertices;
  std::vector<Triangle> fan;
  for (int k = 0; k < facets; ++k) {
    std::array<std::array<double, 2>, 3> flat{};
    for (int i = 0; i < 2; ++i) {
      const double angle = 2 * std::numbers::pi * (k + i) / facets;
      flat[static_cast<std::size_t>(i) + 1] = {std::cos(angle), std::sin(angle)};
    }
    const double x = (flat[1][0] + flat[2][0]) / 3, y = (flat[1][1] + flat[2][1]) / 3;
    const auto first = static_cast<Index>(vertices.size());
    for (const auto& [a, b] : flat) {
      const double s = x + 1.05 * (a - x), t = y + 1.05 * (b - y);
      vertices.push_back({s * u[0] + t * v[0], s * u[1] + t * v[1], s * u[2] + t * v[2]});
    }
    fan.push_back({first, first + 1, first + 2});
  }
  return state_of({vertices, fan, {}, {}, {}});
}

/// It has a new point for each pair of sides, more than many facets that only coincide.
TEST(Flatten, AFanWhoseFacetsAllOverlapIsOneSheet) {
  State state = overlapping_fan(36);
  const Flattened flat = flatten_all(state, kGap, rounded_in_plane, SidesOf::all_sheets, kNoStep);
  EXPECT_GT(flat.moved, 0);
  EXPECT_LT(flat.moved, kGap);
  EXPECT_GT(state.facets.size(), 36u * 36);
  EXPECT_EQ(trouble_of(state, kNoStep, 1).size(), 0u);
}

}  // namespace
}  // namespace holdfast::repairing::flatten_test
