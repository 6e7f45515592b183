// Holes closed: loops of sides that have one facet.
#pragma once

#include <vector>

#include "holdfast/repair.h"
#include "mesh/parallel.h"
#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

struct Holes {
  std::vector<RepairResult::Filled> filled;
  std::vector<RepairResult::LeftOpen> left_open;
};

/// Closes border loops of a valid surface that have at most `most_sides` sides: plane ones by a constrained
/// triangulation, others by triangles of the least area (Barequet, Sharir 1995). What would meet the surface,
/// or another filling, other than in its border stays open. New facets come last and have no parents.
[[nodiscard]] Holes fill_holes(State& state, std::size_t most_sides, const Step& step,
                               const Threads& threads);

}  // namespace holdfast::repairing
