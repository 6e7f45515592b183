// Closes holes: loops of sides with one facet.
#pragma once

#include <span>
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
/// triangulation, others by triangles of the least area (Barequet, Sharir 1995). A hole stays open if its
/// filling would meet the surface or another filling outside its border. New facets come last and have no
/// parents.
[[nodiscard]] Holes fill_holes(State& state, std::size_t most_sides, const Step& step,
                               const Threads& threads);

/// The fillings after facets and vertices were renumbered in `state` (`no_index`: dropped). Fillings without
/// a facet are left out. If a filling lost some of its facets, each connected part of the rest is a filling.
void renumber(Holes& holes, const State& state, std::span<const Index> facet_number,
              std::span<const Index> vertex_number);

}  // namespace holdfast::repairing
