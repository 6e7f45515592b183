// Places where two sides pass each other nearby without a common vertex.
#pragma once

#include <span>
#include <vector>

#include "repair/settle.h"
#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

struct SidesPass {
  double distance = 0;
  Point middle{};  ///< half-way between the nearest points of both
};

/// For each facet the lowest facet of its body. Facets with a common side are of one body.
[[nodiscard]] std::vector<Index> bodies_of(const State& state);

/// Where sides of the elements in trouble pass each other at most `gap` away, the nearest first. `bodies` are
/// those of the facets before vertices were merged, for `Passings::bodies`. Pairs count as work; the search
/// ends when it is spent.
[[nodiscard]] std::vector<SidesPass> passings_of(const State& state, const Trouble& trouble, Passings kind,
                                                 std::span<const Index> bodies, double gap, Work& work,
                                                 const Step& step);

}  // namespace holdfast::repairing
