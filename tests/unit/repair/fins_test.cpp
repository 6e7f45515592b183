// Thin facets attached to a surface.
#include "repair/fins.h"

#include <gtest/gtest.h>

#include "repair/open_sides.h"

namespace holdfast::repairing::fins_test {
namespace {

const double e = 0x1p-50;

/// A tetrahedron with vertices on its side 01, and 4, 5 and 6 beside it, none of them the input's.
State tetrahedron(std::vector<Triangle> fins) {
  const std::vector<Point> vertices{{0, 0, 0},   {1, 0, 0},     {0, 1, 0},      {0, 0, 1},
                                    {0.5, 0, 0}, {0.5, -e, -e}, {0.75, -e, -e}, {0.5, -1, -1}};
  std::vector<Triangle> facets{{0, 2, 4}, {4, 2, 1}, {0, 4, 3}, {4, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  facets.insert(facets.end(), fins.begin(), fins.end());
  State state = state_of({vertices, facets, {}, {}, {}});
  state.input_vertices = 4;
  state.facet_parents = {};
  for (std::size_t f = 0; f < facets.size(); ++f) state.facet_parents.add(std::array{Index(f < 4 ? 0 : 1)});
  return state;
}

TEST(Fins, GoWithTheirVertices) {
  State state = tetrahedron({{4, 1, 5}});
  ASSERT_EQ(open_sides(state), 2u);
  const double moved = drop_fins(state, {}, 4 * e);
  EXPECT_GT(moved, 0);
  EXPECT_LE(moved, 2 * e);
  EXPECT_EQ(open_sides(state), 0u);
  EXPECT_EQ(state.facets.size(), 6u);
  EXPECT_EQ(state.facet_parents.size(), 6u);
  EXPECT_EQ(state.vertices.size(), 5u);
}

TEST(Fins, GoFromTheirFreeSidesInwards) {
  State state = tetrahedron({{4, 1, 5}, {1, 5, 6}});
  const double moved = drop_fins(state, {}, 8 * e);
  EXPECT_GE(moved, 1.4 * e);
  EXPECT_LE(moved, 8 * e);
  EXPECT_EQ(open_sides(state), 0u);
  EXPECT_EQ(state.facets.size(), 6u);
}

TEST(Fins, ThickOnesStay) {
  State state = tetrahedron({{4, 1, 5}});
  EXPECT_EQ(drop_fins(state, {}, e / 2), 0);
  EXPECT_EQ(state.facets.size(), 7u);
  // A thin end of a thick one.
  state = tetrahedron({{4, 1, 5}, {1, 5, 7}});
  EXPECT_EQ(drop_fins(state, {}, 8 * e), 0);
  EXPECT_EQ(state.facets.size(), 8u);
}

TEST(Fins, ThinnerThanWhatIsJoinedGo) {
  State state = tetrahedron({{4, 1, 5}});
  state.vertices[4] = {0.875, 0, 0};
  state.vertices[5] = {0.9375, -e / 4, -e / 4};
  EXPECT_GT(drop_fins(state, {}, e / 8), e / 4);
  EXPECT_EQ(state.facets.size(), 6u);
}

TEST(Fins, TheLastPartOfAFacetStays) {
  State state = tetrahedron({{4, 1, 5}});
  state.facet_parents = {};
  for (Index f = 0; f < 7; ++f) state.facet_parents.add(std::array{f});
  EXPECT_EQ(drop_fins(state, {}, 4 * e), 0);
  EXPECT_EQ(state.facets.size(), 7u);
}

TEST(Fins, TheLastFacetOfAVertexOfTheInputStays) {
  State state = tetrahedron({{4, 1, 5}});
  state.input_vertices = 6;
  EXPECT_EQ(drop_fins(state, {}, 4 * e), 0);
  EXPECT_EQ(state.facets.size(), 7u);
}

TEST(Fins, SidesBeginAtTheirCorners) {
  // The fin is a part of the second facet: of one with a side that begins on it, of one whose sides lead past
  // it, and of one without a corner there.
  const auto left = [](const Triangle& second) {
    State state = tetrahedron({{4, 1, 5}});
    const State given = state_of({state.vertices, std::array{Triangle{0, 2, 3}, second}, {}, {}, {}});
    const double moved = drop_fins(state, given, 4 * e);
    EXPECT_EQ(moved > 0, state.facets.size() == 6);
    return state.facets.size();
  };
  EXPECT_EQ(left({1, 5, 3}), 7u);
  EXPECT_EQ(left({0, 3, 1}), 6u);
  EXPECT_EQ(left({0, 3, 2}), 6u);
}

TEST(Fins, SegmentsStayOnFacets) {
  State state = tetrahedron({{4, 1, 5}});
  state.segments.push_back({4, 5});
  state.segment_parents.add(std::array{Index{0}});
  EXPECT_EQ(drop_fins(state, {}, 4 * e), 0);
  EXPECT_EQ(state.facets.size(), 7u);
}

}  // namespace
}  // namespace holdfast::repairing::fins_test
