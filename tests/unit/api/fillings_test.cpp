// Fillings made ahead on threads are the same as those made on request.
#include "api/fillings.h"

#include <gtest/gtest.h>

#include "api/fill_polyhedron.h"
#include "number_range_surfaces.h"
#include "small_surfaces.h"

namespace holdfast::fillings_test {
namespace {

class FillingsTest : public ::testing::Test {
 protected:
  std::optional<Filling> by_itself(const ToFill& asked) {
    return fill_polyhedron(asked.polyhedron.view(), asked.points, limits_, monitor_);
  }
  void expect_same(const std::optional<Filling>& filling, const ToFill& asked) {
    const std::optional<Filling> expected = by_itself(asked);
    ASSERT_EQ(filling.has_value(), expected.has_value());
    if (!filling) return;
    EXPECT_EQ(filling->added, expected->added);
    EXPECT_EQ(filling->tetrahedra, expected->tetrahedra);
  }

  const Limits limits_;
  const std::function<bool(const Progress&)> progress_;
  Monitor monitor_{limits_, progress_};
  const ToFill box_{small::box(), {.most_recovered = 0, .may_be_added = false}},
      prism_{number_range::schoenhardt(6, 6, 30), {}},
      prism_without_{prism_.polyhedron, {.most_recovered = 0}};
};

TEST_F(FillingsTest, OneThreadMakesNothingAhead) {
  const Threads threads(1);
  Fillings fillings(limits_, monitor_, threads);
  int looks = 0;
  const auto likely = [&](std::size_t) {
    ++looks;
    return std::vector<ToFill>{prism_};
  };
  expect_same(fillings.fill(box_, likely), box_);
  expect_same(fillings.fill(prism_, likely), prism_);
  EXPECT_EQ(looks, 0);
}

TEST_F(FillingsTest, OthersMakeWhatIsLikely) {
  const Threads threads(3);
  Fillings fillings(limits_, monitor_, threads);
  int looks = 0;
  const auto likely = [&](std::size_t most) {
    ++looks;
    EXPECT_GE(most, 2U);
    return std::vector<ToFill>{prism_, prism_without_};
  };
  expect_same(fillings.fill(box_, likely), box_);
  expect_same(fillings.fill(prism_without_, likely),
              prism_without_);  // nothing, with its own limit on points
  expect_same(fillings.fill(prism_, likely), prism_);
  EXPECT_EQ(looks, 1);
  expect_same(fillings.fill(prism_, likely), prism_);  // one filling is for one who asks
  EXPECT_EQ(looks, 2);
}

TEST_F(FillingsTest, WhatWasNotLikelyIsMadeAllTheSame) {
  const Threads threads(2);
  Fillings fillings(limits_, monitor_, threads);
  for (int k = 0; k < 10; ++k)
    expect_same(fillings.fill(k % 2 == 0 ? box_ : prism_,
                              [&](std::size_t) { return std::vector<ToFill>{prism_without_}; }),
                k % 2 == 0 ? box_ : prism_);
}

TEST_F(FillingsTest, EndWhereTheCallIsCancelled) {
  Limits limits;
  limits.cancel = CancelToken();
  Monitor monitor(limits, progress_);
  const Threads threads(2);
  Fillings fillings(limits, monitor, threads);
  const auto cancelling = [&](std::size_t) {
    limits.cancel->cancel();
    return std::vector<ToFill>{prism_};
  };
  EXPECT_THROW(std::ignore = fillings.fill(box_, cancelling), Interrupted);
}

}  // namespace
}  // namespace holdfast::fillings_test
