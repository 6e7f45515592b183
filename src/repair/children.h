// The parts of each facet of the input.
#pragma once

#include <span>
#include <vector>

#include "repair/state.h"

namespace holdfast::repairing {

class Children {
 public:
  /// Finds the parts, in `state` as it is now, of the facets of `given`. `given` must outlive this object.
  Children(const State& state, const State& given);

  /// Facets of the state, ascending. Repeated facets of the input have the same parts.
  [[nodiscard]] std::span<const Index> of(Index facet) const;

 private:
  const State& given_;
  std::vector<std::vector<Index>> by_parent_;
};

}  // namespace holdfast::repairing
