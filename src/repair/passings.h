// Places where two sides pass each other nearby without a common vertex.
#pragma once

#include <array>
#include <vector>

#include "repair/settle.h"
#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

struct SidesPass {
  double distance = 0;
  Point middle{};  ///< half-way between the nearest points of both
  std::array<std::array<Index, 2>, 2> sides{};  ///< ends, ascending
};

/// Where sides of the elements in trouble pass each other at most `gap` away, the nearest first. Pairs count
/// as work; the search ends when it is spent.
[[nodiscard]] std::vector<SidesPass> passings_of(const State& state, const Trouble& trouble, Passings kind,
                                                 double gap, Work& work, const Step& step);

}  // namespace holdfast::repairing
