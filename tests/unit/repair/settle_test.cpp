// Elements too close to each other are joined by bending: limits of the number of new facets.
#include "repair/settle.h"

#include <gtest/gtest.h>

#include <numeric>

#include "small_surfaces.h"

namespace holdfast::repairing::settle_test {
namespace {

/// Needles of a plane that cross each other within the gap, all in trouble.
State needles(int n) {
  Surface surface;
  for (int k = 0; k < n; ++k)
    small::add_triangle(surface, {0.0 - k, 1e-3 * k, 0}, {10.0 + k, 1e-3 * (n - k), 0},
                        {5, 1e-3 * (k + 1), 0});
  return state_of(surface.view());
}

std::size_t facets_settled(State state, std::size_t most, Work work = {}) {
  Trouble all;
  all.facets.resize(state.facets.size());
  std::iota(all.facets.begin(), all.facets.end(), Index{0});
  settle(state, all, {1e-2, 0, false, Passings::all, most}, work, [](double) {});
  return state.facets.size();
}

TEST(Settle, EndsIfThereAreTooManyNewFacets) {
  const State state = needles(12);
  const std::size_t without_limit = facets_settled(state, SIZE_MAX), most = 2 * state.facets.size();
  ASSERT_GT(without_limit, 2 * most);
  const std::size_t ended = facets_settled(state, most);
  EXPECT_GT(ended, most);
  EXPECT_LT(ended, without_limit / 2);
}

TEST(Settle, EndsWhenItsWorkIsSpent) {
  const State state = needles(12);
  EXPECT_LT(facets_settled(state, SIZE_MAX, {1000}), facets_settled(state, SIZE_MAX) / 2);
}

/// Two adjacent vertices, each next to the side from the first one to the other: segments there may be routed
/// through either.
TEST(Settle, SegmentsAreNotMovedBackAndForth) {
  constexpr Index kSegments = 20;
  State state = state_of({{}, {}, {}, {}, {}});
  state.vertices = {{0, 0, 0}, {10, 1e-9, 0}, {10, -1e-9, 0}, {20, 0, 1}};
  state.input_vertices = state.vertices.size();
  for (Index s = 0; s < kSegments; ++s) {
    state.segments.push_back({0, 1});
    state.segment_parents.add(std::array{s});
  }
  state.segments.push_back({2, 3});
  state.segment_parents.add(std::array{kSegments});
  Trouble all;
  all.segments.resize(state.segments.size());
  std::iota(all.segments.begin(), all.segments.end(), Index{0});
  Work work;
  settle(state, all, {1e-2, 0, false, Passings::none, SIZE_MAX}, work, [](double) {});
  EXPECT_GT(work.done, 0u);
  EXPECT_LT(work.done, 100u * kSegments);
}

// A new vertex at the place of a vertex of the input becomes another one nearby, and the input's stays.
TEST(Settle, VerticesOfTheInputStayWhereNewOnesAtTheirPlacesGo) {
  State state = state_of({{}, {}, {}, {}, {}});
  const Point other{0, 0, 0}, place{1e-3, 0, 0};
  state.vertices = {other, {5, 1, 0}, {5, 0, 1}, place, {5, 3, 0}, {5, 0, 3}, place, {-5, 1, 0}, {-5, 0, 1}};
  state.input_vertices = 6;
  for (Index f = 0; f < 3; ++f) {
    state.facets.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    state.facet_parents.add(std::array{f});
  }
  state.known = {1, 1, 0};
  Work work;
  settle(state, everything(state), {1e-2, 0, false, Passings::none}, work, [](double) {});
  EXPECT_EQ(state.vertices[3], place);
  EXPECT_EQ(state.facets.back()[0], 0u) << "the new vertex has become the other one";
}

}  // namespace
}  // namespace holdfast::repairing::settle_test
