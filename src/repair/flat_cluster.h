// The facets of a cluster in the plane, with their sides as segments, and what comes of them there.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "repair/clusters.h"
#include "repair/state.h"

namespace holdfast::repairing {

using Side = std::array<Index, 2>;  // ascending

struct Flat {
  State state;
  std::vector<Index> vertices;  // of the state
  std::vector<Side> sides;      // ascending
};

[[nodiscard]] Flat flat_of(const State& state, const Cluster& cluster);

/// Where a facet was folded by rounding, triangles of which it has two parts have become one, and there is
/// a gap. Such are no parts of it. False where gaps stay.
[[nodiscard]] bool make_whole(const Cluster& cluster, const Flat& before, State& after,
                              std::span<const std::vector<Index>> chains);

/// The vertices of a path between the ends of a side, without the ends; false where the pieces are none.
[[nodiscard]] bool chain_of(const std::vector<Segment>& pieces, const Segment& side,
                            std::vector<Index>& chain);

}  // namespace holdfast::repairing
