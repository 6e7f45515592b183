// Facets that an exact search found to fit together are recognised when they occur again.
#include "repair/proven.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "small_surfaces.h"

namespace holdfast::repairing {
namespace {

using Flags = std::vector<std::uint8_t>;

/// The sides of a box; the first does not fit.
State searched() {
  const Surface box = small::open_box();
  State state = state_of(box.view());
  state.known.assign(state.facets.size(), 1);
  state.known[0] = 0;
  return state;
}

TEST(Proven, RecognisesFacetsByTheirPlaces) {
  const State before = searched();
  State state = before;
  state.known.clear();
  std::reverse(state.vertices.begin(), state.vertices.end());
  for (Triangle& t : state.facets) {
    for (Index& v : t) v = static_cast<Index>(state.vertices.size()) - 1 - v;
    std::rotate(t.begin(), t.begin() + 1, t.end());
  }
  Proven(before).tell(state);
  EXPECT_EQ(state.known, before.known);
  EXPECT_FALSE(state.knows_vertices);
}

TEST(Proven, DoesNotRecogniseFacetsThatOccurTwiceOrMoved) {
  const State before = searched();
  State state = before;
  state.known.clear();
  state.facets.push_back(state.facets[1]);
  state.vertices.push_back(state.vertices[state.facets[2][0]]);
  state.vertices.back()[0] += 0.125;
  state.facets[2][0] = static_cast<Index>(state.vertices.size() - 1);
  Proven(before).tell(state);
  Flags expected(state.facets.size(), 1);
  for (const std::size_t f : {std::size_t{0}, std::size_t{1}, std::size_t{2}, state.facets.size() - 1})
    expected[f] = 0;
  EXPECT_EQ(state.known, expected);
}

TEST(Proven, DoesNotChangeAStateThatKnowsMore) {
  const State before = searched();
  State state = before;
  state.known.assign(state.facets.size(), 1);
  Proven(before).tell(state);
  EXPECT_EQ(state.known, Flags(state.facets.size(), 1));
  EXPECT_TRUE(state.knows_vertices);
}

}  // namespace
}  // namespace holdfast::repairing
