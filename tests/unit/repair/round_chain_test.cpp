// Which triangles of a plane mesh a closed chain of its edges encloses.
#include "repair/round_chain.h"

#include <gtest/gtest.h>

namespace holdfast::repairing::round_chain_test {
namespace {

using Chain = std::vector<RoundChain::Step>;
using Triangles = std::vector<Index>;

// Four vertices of a square, 0 to 3, round a centre, 4, and a fifth triangle at the side 1 2.
const std::vector<Triangle> kMesh{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {2, 1, 5}};

TEST(RoundChain, EnclosesTheTrianglesOnItsLeft) {
  const RoundChain round(kMesh);
  EXPECT_EQ(round.inside(Chain{{0, 1}, {1, 2}, {2, 3}, {3, 0}}), (Triangles{0, 1, 2, 3}));
  EXPECT_EQ(round.inside(Chain{{0, 1}, {1, 4}, {4, 0}}), (Triangles{0}));
}

TEST(RoundChain, TheDirectionDoesNotMatter) {
  const RoundChain round(kMesh);
  EXPECT_EQ(round.inside(Chain{{0, 3}, {3, 2}, {2, 1}, {1, 0}}), (Triangles{0, 1, 2, 3}));
  EXPECT_EQ(round.inside(Chain{{1, 0}, {0, 4}, {4, 1}}), (Triangles{0}));
}

TEST(RoundChain, EdgesThatOccurTwiceDoNotCount) {
  const RoundChain round(kMesh);
  EXPECT_EQ(round.inside(Chain{{0, 1}, {1, 4}, {4, 2}, {2, 4}, {4, 0}}), (Triangles{0}));
  EXPECT_EQ(round.inside(Chain{{0, 1}, {1, 0}}), Triangles{});
}

TEST(RoundChain, LoopsOfBothDirectionsMeetInAVertex) {
  const RoundChain round(kMesh);
  // Counterclockwise round the first triangle, and clockwise round the third.
  EXPECT_EQ(round.inside(Chain{{0, 1}, {1, 4}, {4, 3}, {3, 2}, {2, 4}, {4, 0}}), (Triangles{0, 2}));
}

TEST(RoundChain, TwoChainsTogetherEncloseTheSameAsTheirSum) {
  const RoundChain round(kMesh);
  const Chain square{{0, 1}, {1, 2}, {2, 3}, {3, 0}}, beside{{2, 1}, {1, 5}, {5, 2}};
  Chain both = square;
  both.insert(both.end(), beside.begin(), beside.end());
  EXPECT_EQ(round.inside(both), (Triangles{0, 1, 2, 3, 4}));
}

}  // namespace
}  // namespace holdfast::repairing::round_chain_test
