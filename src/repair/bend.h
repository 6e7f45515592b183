// Bends sides and facets through the vertices that they pass nearby.
#pragma once

#include <span>

#include "repair/settle.h"
#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

struct Bend {
  double gap = 0;
  double room = 0;  ///< no facet is bent by more than this in all
  std::size_t most_facets = SIZE_MAX;
  Touching touching = Touching::bends;
};

/// Leads the sides and facets in trouble through those of `vertices` (ascending) that they pass at most `gap`
/// away. Ends early if there are too many facets or the work is spent. Returns the largest distance by which
/// anything was bent, rounded up.
double bend(State& state, const Trouble& trouble, std::span<const Index> vertices, const Bend& how,
            Work& work, const Step& step);

}  // namespace holdfast::repairing
