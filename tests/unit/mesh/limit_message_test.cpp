// The messages of calls that a limit ended.
#include "mesh/limit_message.h"

#include <gtest/gtest.h>

#include "holdfast/repair.h"

namespace holdfast::limit_message_test {
namespace {

TEST(LimitMessage, NamesTheLimitAsItWasGiven) {
  Limits limits;
  limits.time_limit = 3;
  limits.memory_limit = 2'500'000'000;
  EXPECT_EQ(limit_message(Outcome::time_limit, limits), "the time limit of 3 s ran out");
  EXPECT_EQ(limit_message(Outcome::memory_limit, limits), "the memory limit of 2.5 GB was reached");
  EXPECT_EQ(limit_message(Outcome::cancelled, limits), "cancelled");
}

TEST(LimitMessage, OfARepair) {
  const std::vector<Point> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Triangle> facets{{0, 1, 2}};
  RepairOptions options;
  options.time_limit = 1e-9;
  const RepairResult result = repair({vertices, facets, {}, {}, {}}, options);
  EXPECT_EQ(result.outcome, Outcome::time_limit);
  EXPECT_EQ(result.message, "the time limit of 1e-09 s ran out");
}

}  // namespace
}  // namespace holdfast::limit_message_test
