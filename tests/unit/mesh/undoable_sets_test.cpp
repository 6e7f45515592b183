// Sets that are joined, taken apart again and listed.
#include "mesh/undoable_sets.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <utility>
#include <vector>

namespace holdfast::undoable_sets_test {
namespace {

constexpr Index kMembers = 40;

/// The set of v after these joins.
std::set<Index> set_of(Index v, const std::vector<std::pair<Index, Index>>& joins) {
  std::set<Index> all{v};
  for (std::size_t before = 0; before < all.size();) {
    before = all.size();
    for (const auto& [a, b] : joins)
      if (all.contains(a) || all.contains(b)) all.insert({a, b});
  }
  return all;
}

void expect_equal(const UndoableSets& sets, const std::vector<std::pair<Index, Index>>& joins) {
  for (Index v = 0; v < kMembers; ++v) {
    std::set<Index> members;
    std::size_t listed = 0;
    sets.for_each_member(v, [&](Index w) {
      members.insert(w);
      ++listed;
      EXPECT_EQ(sets.root(w), sets.root(v));
    });
    EXPECT_EQ(members, set_of(v, joins));
    EXPECT_EQ(listed, members.size());
  }
}

TEST(UndoableSets, AreWhatTheJoinsThatWereNotTakenBackMake) {
  std::mt19937 random(1);
  for (int turn = 0; turn < 20; ++turn) {
    UndoableSets sets(kMembers);
    std::vector<std::pair<Index, Index>> joins;
    std::vector<std::pair<std::size_t, std::size_t>> marks;  // of the sets, and of the joins
    for (int step = 0; step < 60; ++step) {
      if (step % 7 == 0) marks.emplace_back(sets.mark(), joins.size());
      joins.emplace_back(random() % kMembers, random() % kMembers);
      sets.unite(joins.back().first, joins.back().second);
      if (step % 11 != 10) continue;
      sets.undo_to(marks.back().first);
      joins.resize(marks.back().second);
      marks.pop_back();
      expect_equal(sets, joins);
    }
    expect_equal(sets, joins);
    sets.undo_to(0);
    expect_equal(sets, {});
  }
}

}  // namespace
}  // namespace holdfast::undoable_sets_test
