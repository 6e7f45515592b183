// The facets of a cluster in the plane, with their sides as segments, and their parts there.
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

/// If rounding folded a facet, two of its parts have become the same triangle, and this leaves a gap. Such
/// triangles are taken from the facet's parts. False if gaps stay.
[[nodiscard]] bool make_whole(const Cluster& cluster, const Flat& before, State& after,
                              std::span<const std::vector<Index>> chains);

/// The vertices of the path between the ends of a side, without the ends; false if the pieces are not a path.
[[nodiscard]] bool chain_of(const std::vector<Segment>& pieces, const Segment& side,
                            std::vector<Index>& chain);

}  // namespace holdfast::repairing
