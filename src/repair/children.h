// The parts of the facets of the input.
#pragma once

#include <span>
#include <vector>

#include "repair/state.h"

namespace holdfast::repairing {

class Children {
 public:
  /// Of facets of `given` in `state`, as it is now. `given` must outlive it.
  Children(const State& state, const State& given);

  /// Facets of the state, ascending. Those of facets of the input that were the same are the same.
  [[nodiscard]] std::span<const Index> of(Index facet) const;

 private:
  const State& given_;
  std::vector<std::vector<Index>> by_parent_;
};

}  // namespace holdfast::repairing
