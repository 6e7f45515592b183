// A mesh with field points, and the promise checked on it.
#pragma once

#include <gtest/gtest.h>

#include "holdfast/check.h"
#include "holdfast/holdfast.h"

namespace holdfast::testing {

inline Result mesh_with(const Surface& surface, const Sizes& sizes, Options options = {}) {
  options.sizes = sizes;
  Result result = mesh(surface.view(), options);
  EXPECT_EQ(result.outcome, Outcome::done) << result.message;
  for (const Rule& rule : check(surface.view(), result.volume).rules)
    EXPECT_TRUE(rule.holds) << rule.name << ": " << rule.detail;
  return result;
}

}  // namespace holdfast::testing
