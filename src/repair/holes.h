// Holes closed: loops of sides that have one facet.
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
/// triangulation, others by triangles of the least area (Barequet, Sharir 1995). What would meet the surface,
/// or another filling, other than in its border stays open. New facets come last and have no parents.
[[nodiscard]] Holes fill_holes(State& state, std::size_t most_sides, const Step& step,
                               const Threads& threads);

/// What is left of them once facets and vertices have these numbers in `state`, or `no_index` where they
/// went. Fillings without a facet are none; where some facets of one went, each connected part of the rest is
/// one.
void renumber(Holes& holes, const State& state, std::span<const Index> facet_number,
              std::span<const Index> vertex_number);

}  // namespace holdfast::repairing
