// Validation gives the same defects in the same order for any number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "surface/aabb_tree.h"
#include "surface/complex.h"
#include "surface/diagnose.h"

namespace holdfast::surface_threads_test {
namespace {

// A bumpy sheet of 2 n^2 triangles.
Surface sheet(Index n) {
  Surface s;
  for (Index i = 0; i <= n; ++i)
    for (Index j = 0; j <= n; ++j) {
      const double x = i, y = j;
      s.vertices.push_back({x, y, std::sin(0.3 * x) * std::cos(0.2 * y)});
    }
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const Index a = i * (n + 1) + j, b = a + 1, c = a + n + 1, d = c + 1;
      s.facets.push_back({a, b, d});
      s.facets.push_back({a, d, c});
    }
  return s;
}

void expect_same_defects(const Surface& s, std::size_t most, std::size_t at_least) {
  const std::vector<Defect> one = find_defects(
      s.view(), most, [](double) {}, 1);
  EXPECT_GE(one.size(), at_least);
  for (const unsigned threads : {2u, 4u}) {
    const std::vector<Defect> many = find_defects(
        s.view(), most, [](double) {}, threads);
    ASSERT_EQ(one.size(), many.size());
    for (std::size_t k = 0; k < one.size(); ++k) {
      EXPECT_EQ(one[k].kind, many[k].kind);
      EXPECT_EQ(one[k].facets, many[k].facets);
      EXPECT_EQ(one[k].segments, many[k].segments);
      EXPECT_EQ(one[k].vertices, many[k].vertices);
    }
  }
}

TEST(SurfaceThreads, ValidSurface) { expect_same_defects(sheet(80), 100, 0); }

TEST(SurfaceThreads, CrossingFacets) {
  Surface s = sheet(80);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> at(2, 70), step(0.5, 3);
  for (int k = 0; k < 40; ++k) {
    const auto first = static_cast<Index>(s.vertices.size());
    const double x = at(random), y = at(random);
    s.vertices.push_back({x, y, -3});
    s.vertices.push_back({x + step(random), y, 3});
    s.vertices.push_back({x, y + step(random), 2});
    s.facets.push_back({first, first + 1, first + 2});
  }
  expect_same_defects(s, SIZE_MAX, 40);
  expect_same_defects(s, 5, 5);
}

TEST(SurfaceThreads, RepeatedFacets) {
  Surface s = sheet(110);
  for (std::size_t k = 0; k < 3000; ++k) s.facets.push_back(s.facets[k * 4]);
  expect_same_defects(s, SIZE_MAX, 3000);
}

TEST(SurfaceThreads, StepStopsTheSearch) {
  const Surface s = sheet(120);
  const auto stop = [](double) { throw std::runtime_error("enough"); };
  EXPECT_THROW(static_cast<void>(find_defects(s.view(), 1, stop, 2)), std::runtime_error);
}

TEST(SurfaceThreads, TreeOfManyThreadsAndItsDivision) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> at(0, 60), size(0, 1);
  std::vector<Box> boxes(20000);
  std::vector<Index> group(boxes.size(), no_index);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      boxes[i].low[k] = at(random);
      boxes[i].high[k] = boxes[i].low[k] + size(random);
    }
    if (i % 3 == 0) group[i] = static_cast<Index>(i % 50);
  }
  const auto never = [](Index, Index) { return false; };
  const auto pairs_of = [&](const AabbTree& tree, std::size_t parts) {
    std::set<std::pair<Index, Index>> pairs;
    const auto visit = [&](Index i, Index j) {
      EXPECT_TRUE(pairs.insert({std::min(i, j), std::max(i, j)}).second);
      return true;
    };
    for (const auto& top : tree.divided(parts)) tree.for_each_overlap(top, visit, never, [](double) {});
    return pairs;
  };
  const auto expected = pairs_of(AabbTree(boxes, group), 1);
  EXPECT_GT(expected.size(), 500u);
  for (const unsigned threads : {1u, 2u, 4u})
    for (const std::size_t parts : {7u, 300u})
      EXPECT_EQ(pairs_of(AabbTree(boxes, group, threads), parts), expected);
}

}  // namespace
}  // namespace holdfast::surface_threads_test
