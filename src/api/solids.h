// What the components of an arranged surface keep, each by itself, and which of them are cavities of others.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "holdfast/types.h"
#include "mesh/undoable_sets.h"

namespace holdfast {

/// The regions on both sides of a facet of the arrangement that is part of a component's facet.
struct RegionPair {
  Index front, back;
  auto operator<=>(const RegionPair&) const = default;
};

/// Which way all facets of a component face.
enum class Facing { outwards, inwards, mixed };

/// What a component keeps by itself.
struct Solid {
  std::vector<Index> regions;  ///< ascending
  Facing facing = Facing::mixed;
};

/// What a component with these walls keeps. `sets` joins regions that only other components separate. Inside
/// is where the winding number is not zero, if all facets agree on it; otherwise, whatever the walls close
/// off from region 0.
[[nodiscard]] Solid solid_of(const std::vector<RegionPair>& walls, const UndoableSets& sets);

/// The regions that at least one component keeps, where those of a cavity do not count for the component in
/// which it is. The component round another one is the least of those that keep both sides of all of its
/// facets. If it faces the other way, and is no cavity itself, the other one is its cavity.
[[nodiscard]] std::vector<std::uint8_t> material_of(std::size_t regions, const std::vector<Solid>& solids,
                                                    const std::vector<std::vector<RegionPair>>& walls);

}  // namespace holdfast
