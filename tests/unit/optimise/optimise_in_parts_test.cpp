// The search of --fill on several threads (src/optimise/search_in_parts.h).
#include <gtest/gtest.h>

#include "holdfast/holdfast.h"
#include "torus.h"

namespace holdfast::optimise_in_parts_test {
namespace {

// So many tetrahedra are cut into parts. Flips do not remove all elements of four points on one circle.
TEST(SearchInParts, NullElementsGetPointsOnAnyNumberOfThreads) {
  const Surface surface = torus(240, 120);
  std::vector<Volume> results;
  for (const unsigned threads : {1u, 3u}) {
    Options options;
    options.threads = threads;
    Result result = mesh(surface.view(), options);
    ASSERT_EQ(result.outcome, Outcome::done);
    EXPECT_GT(result.volume.tetrahedra.size(), 80'000u);
    EXPECT_GT(result.report.optimised.points, 500u);
    EXPECT_LT(result.report.elements.worst, 1e5);
    results.push_back(std::move(result.volume));
  }
  EXPECT_EQ(results[0].tetrahedra, results[1].tetrahedra);
  EXPECT_EQ(results[0].vertices, results[1].vertices);
}

}  // namespace
}  // namespace holdfast::optimise_in_parts_test
