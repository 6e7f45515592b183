// Facets that an exact search found to fit together are recognised when they occur again.
#include "repair/proven.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "small_surfaces.h"

namespace holdfast::repairing::proven_test {
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
  Proven(before, before.known).tell(state);
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
  Proven(before, before.known).tell(state);
  Flags expected(state.facets.size(), 1);
  for (const std::size_t f : {std::size_t{0}, std::size_t{1}, std::size_t{2}, state.facets.size() - 1})
    expected[f] = 0;
  EXPECT_EQ(state.known, expected);
}

TEST(Proven, DoesNotChangeAStateThatKnowsMore) {
  const State before = searched();
  State state = before;
  state.known.assign(state.facets.size(), 1);
  Proven(before, before.known).tell(state);
  EXPECT_EQ(state.known, Flags(state.facets.size(), 1));
  EXPECT_TRUE(state.knows_vertices);
}

Flags all_but(const State& state, std::initializer_list<std::size_t> unknown) {
  Flags flags(state.facets.size(), 1);
  for (const std::size_t f : unknown) flags[f] = 0;
  return flags;
}

Flags told(const ProvenSets& sets, State state) {
  state.known.clear();
  sets.tell(state);
  return state.known;
}

TEST(ProvenSets, TellsTheSetThatKnowsMost) {
  State state = searched();
  state.known = all_but(state, {0, 1, 2});
  ProvenSets sets;
  EXPECT_TRUE(sets.empty());
  sets.begin(state);
  EXPECT_FALSE(sets.empty());
  EXPECT_EQ(told(sets, state), all_but(state, {0, 1, 2}));
  sets.add(state, all_but(state, {3}));
  sets.add(state, all_but(state, {4, 5}));
  EXPECT_EQ(told(sets, state), all_but(state, {3}));
}

TEST(ProvenSets, KeepsTheFirstSetAndTheLastTwo) {
  State state = searched();
  state.known = all_but(state, {0, 1, 2});
  ProvenSets sets;
  sets.begin(state);
  sets.add(state, all_but(state, {3}));
  sets.add(state, all_but(state, {4, 5, 6, 7}));
  sets.add(state, all_but(state, {5, 6, 7, 8}));
  EXPECT_EQ(told(sets, state), all_but(state, {0, 1, 2}));
}

TEST(ProvenSets, LeavesOutSearchesOfFewFacetsAndThoseThatDidNotEnd) {
  State state = searched();
  state.known = all_but(state, {0, 1, 2});
  ProvenSets sets;
  sets.begin(state);
  sets.add(state, {});
  EXPECT_EQ(told(sets, state), all_but(state, {0, 1, 2}));
  state.known = all_but(state, {0});
  sets.add(state, all_but(state, {}));
  EXPECT_EQ(told(sets, state), all_but(state, {1, 2, 0}));
}

}  // namespace
}  // namespace holdfast::repairing::proven_test
