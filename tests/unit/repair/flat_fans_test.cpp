// Fans whose facets share no area in a projection, and the search that leaves out their pairs.
#include "repair/flat_fans.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "numbers/random.h"
#include "repair/clusters.h"

namespace holdfast::repairing::flat_fans_test {
namespace {

const Step kNoStep = [](double) {};
constexpr unsigned kAxis = 2;

/// Adds a fan round the vertex 0 whose rim turns by `turns` circles, at a height.
void add_fan(State& state, int facets, double turns, double height) {
  const auto first = static_cast<Index>(state.vertices.size());
  for (int k = 0; k <= facets; ++k) {
    const double angle = 2 * std::numbers::pi * turns * k / facets;
    state.vertices.push_back({std::cos(angle), std::sin(angle), height});
    if (k == facets) break;
    const auto at = first + static_cast<Index>(k);
    state.facets.push_back({0, at, at + 1});
  }
}

State state_with_centre() {
  State state;
  state.vertices = {{0, 0, 0}};
  return state;
}

std::vector<std::array<Index, 3>> fans_of(const State& state) {
  std::vector<Index> facets(state.facets.size());
  std::iota(facets.begin(), facets.end(), Index{0});
  const std::vector<std::uint8_t> axis(facets.size(), kAxis);
  return FlatFans(state, facets, axis).of();
}

TEST(FlatFans, ADiscIsOneFan) {
  State state = state_with_centre();
  add_fan(state, 100, 1, 0);
  const auto fans = fans_of(state);
  ASSERT_EQ(fans.size(), 100u);
  for (const auto& fan : fans) EXPECT_EQ(fan, (std::array<Index, 3>{0, no_index, no_index}));
}

TEST(FlatFans, TheSenseOfRotationAndTheOrderOfCornersDoNotMatter) {
  State state = state_with_centre();
  add_fan(state, 40, -0.9, 0);
  for (std::size_t f = 0; f < state.facets.size(); ++f)
    std::rotate(state.facets[f].begin(), state.facets[f].begin() + static_cast<std::ptrdiff_t>(f % 3),
                state.facets[f].end());
  EXPECT_EQ(fans_of(state).size(), 40u);
}

TEST(FlatFans, WhatOverlapsItselfIsNoFan) {
  State twice = state_with_centre();
  add_fan(twice, 100, 1.01, 0);
  EXPECT_TRUE(fans_of(twice).empty());
  State one_more = state_with_centre();
  add_fan(one_more, 100, 1, 0);
  one_more.facets.push_back({0, 50, 52});
  EXPECT_TRUE(fans_of(one_more).empty());
  State same = state_with_centre();
  add_fan(same, 100, 1, 0);
  same.facets.push_back(same.facets[7]);
  EXPECT_TRUE(fans_of(same).empty());
}

TEST(FlatFans, FewFacetsAreNoFan) {
  State state = state_with_centre();
  add_fan(state, 8, 1, 0);
  EXPECT_TRUE(fans_of(state).empty());
}

/// Whether two triangles share no area: a side of one has the other beyond it.
bool are_apart(const State& state, const Triangle& t, const Triangle& u) {
  const auto turn = [&](Index a, Index b, Index c) {
    const Point &p = state.vertices[a], &q = state.vertices[b], &r = state.vertices[c];
    const double turn = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);  // small integers
    return (turn > 0) - (turn < 0);
  };
  const auto parts = [&](const Triangle& a, const Triangle& b) {
    const int of_a = turn(a[0], a[1], a[2]);
    for (std::size_t i = 0; i < 3; ++i) {
      bool beyond = true;
      for (const Index v : b) beyond = beyond && turn(a[i], a[(i + 1) % 3], v) * of_a <= 0;
      if (beyond) return true;
    }
    return false;
  };
  return parts(t, u) || parts(u, t);
}

/// Facets round a vertex on a grid of integers, with many collinear corners: those of one fan never overlap.
TEST(FlatFans, FacetsOfOneFanShareNoArea) {
  numbers::Random random(3);
  int fans = 0, none = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    State state = state_with_centre();
    for (int k = 0; k < 24; ++k) {
      const double angle = 2 * std::numbers::pi * k / 24;
      const double far = 5 + static_cast<double>(numbers::below(20, random));
      state.vertices.push_back({std::round(far * std::cos(angle)), std::round(far * std::sin(angle)), 0});
    }
    for (Index k = 0; k < 24; ++k) {
      const auto next = static_cast<Index>(k + 1 + numbers::below(trial % 4 == 0 ? 2 : 1, random));
      state.facets.push_back({0, 1 + k, 1 + next % 24});
    }
    const auto of = fans_of(state);
    (of.empty() ? none : fans) += 1;
    for (std::size_t f = 0; f < of.size(); ++f)
      for (std::size_t g = 0; g < f; ++g) {
        const bool together = of[f][0] != no_index && of[f][0] == of[g][0];
        EXPECT_TRUE(!together || are_apart(state, state.facets[f], state.facets[g]));
      }
  }
  EXPECT_GT(fans, 500);
  EXPECT_GT(none, 500);
}

TEST(Clusters, OfTwoDiscsHasAllFacetsAndOfOneNone) {
  State state = state_with_centre();
  add_fan(state, 60, 1, 0);
  EXPECT_TRUE(find_clusters(state, 1e-9, {}, kNoStep).facets.empty());
  add_fan(state, 47, 1, 1e-10);
  const Clusters clusters = find_clusters(state, 1e-9, {}, kNoStep);
  ASSERT_EQ(clusters.all.size(), 1u);
  EXPECT_EQ(clusters.facets.size(), 60u + 47u);
}

}  // namespace
}  // namespace holdfast::repairing::flat_fans_test
