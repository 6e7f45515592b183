// Fans of facets round a vertex that share no area in the projection of their plane.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "repair/state.h"

namespace holdfast::repairing {

/// The fans of a dozen facets or more. A search for facets that overlap would otherwise compare all pairs
/// of a fan, because their boxes overlap at its vertex: a disc of n triangles has n * n / 2 of them.
class FlatFans {
 public:
  /// `axis` has the axis along which each of `facets` is projected. Facets of one fan have the same one.
  FlatFans(const State& state, std::span<const Index> facets, std::span<const std::uint8_t> axis);

  /// The fans of each facet, in the order of `facets`; unused places hold `no_index`. Empty if there are no
  /// fans.
  [[nodiscard]] const std::vector<std::array<Index, 3>>& of() const { return of_; }
  /// The first fan of each facet, or `no_index`. Empty if there are no fans.
  [[nodiscard]] std::vector<Index> first() const;

 private:
  std::vector<std::array<Index, 3>> of_;
};

}  // namespace holdfast::repairing
