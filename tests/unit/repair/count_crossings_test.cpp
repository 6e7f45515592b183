// Crossings that are counted without being made.
#include "arrange/count_crossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace holdfast::arrange::count_crossings_test {
namespace {

using plane::Position;

/// n lines from left to right, and n from bottom to top.
std::vector<Piece> grid(int n) {
  std::vector<Piece> pieces;
  for (int i = 1; i <= n; ++i) {
    const double at = i;
    pieces.push_back({Position{0, at}, Position{n + 1.0, at}});
    pieces.push_back({Position{at, 0}, Position{at, n + 1.0}});
  }
  return pieces;
}

TEST(CountCrossings, CountsEachPointOfAGrid) { EXPECT_EQ(count_crossings(grid(20), {}, 1000), 400u); }

TEST(CountCrossings, EndsWhereEnoughAreFound) {
  EXPECT_GE(count_crossings(grid(20), {}, 100), 100u);
  EXPECT_LE(count_crossings(grid(20), {}, 100), 113u);
}

// With the diagonals six pairs of lines cross in a point, so the first crossings found are few points.
TEST(CountCrossings, GoesOnWhereSeveralCrossInEachPlace) {
  std::vector<Piece> pieces = grid(20);
  for (int k = -18; k < 19; ++k) {
    const Position low{0.5 + std::max(0, k), 0.5 + std::max(0, -k)};
    const Position high{20.5 + std::min(0, k), 20.5 + std::min(0, -k)};
    pieces.push_back({low, high});
    pieces.push_back({Position{21 - low[0], low[1]}, Position{21 - high[0], high[1]}});
  }
  EXPECT_GE(count_crossings(pieces, {}, 380), 380u);
}

// Ten lines through one point are 45 pairs that cross.
TEST(CountCrossings, CountsAPointOfManyLinesOnce) {
  std::vector<Piece> pieces;
  for (int i = 0; i < 10; ++i) {
    const double x = i - 4.5;
    pieces.push_back({Position{x, -1}, Position{-x, 1}});
  }
  EXPECT_EQ(count_crossings(pieces, {}, 1000), 1u);
}

TEST(CountCrossings, LeavesOutGivenPoints) {
  const std::vector<Position> points{{3, 4}, {5, 5}};
  EXPECT_EQ(count_crossings(grid(20), points, 1000), 398u);
}

// One ends in the other; two cross so flat that rounded ends decide.
TEST(CountCrossings, LeavesOutWhatIsNotCertain) {
  const std::vector<Piece> touch{{Position{0, 0}, Position{2, 0}}, {Position{1, 0}, Position{1, 1}}};
  EXPECT_EQ(count_crossings(touch, {}, 1000), 0u);
  const std::vector<Piece> flat{{Position{0, 1}, Position{2, 1 + 0x1p-52}},
                                {Position{0, 1 + 0x1p-52}, Position{2, 1}}};
  EXPECT_EQ(count_crossings(flat, {}, 1000), 0u);
}

}  // namespace
}  // namespace holdfast::arrange::count_crossings_test
