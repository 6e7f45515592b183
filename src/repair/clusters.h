// Facets that overlap up to rounding, and the plane in which they overlap.
#pragma once

#include <span>
#include <vector>

#include "repair/near.h"
#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

/// Facets that overlap, with the axis along which their plane is projected.
struct Cluster {
  std::vector<Index> facets;
  unsigned axis = 0;
};

struct Clusters {
  std::vector<Cluster> all;
  std::vector<Index> facets;  ///< all facets that overlap another one, ascending: some are in no cluster
};

/// Clusters of facets that lie within `gap` of each other's planes. Only pairs with a facet among `some`
/// count, unless `some` is empty.
[[nodiscard]] Clusters find_clusters(const State& state, double gap, std::span<const Index> some,
                                     const Step& step);

/// The normal of a facet; its length is twice the facet's area.
[[nodiscard]] Vector normal_of(const State& state, Index facet);

}  // namespace holdfast::repairing
