// The regions into which a valid surface divides space, found without a mesh.
//
// Half-facets that face each other round a side see the same region, so they form shells. For facets that are
// connected by sides, every region of space without them has one shell: space without a finite set of
// vertices is simply connected, so the number of shells is that of the regions (Mayer and Vietoris 1930). One
// line to infinity from each such set of facets then tells which shells see the same region
// (docs/decisions/regions-without-a-mesh.md).
#pragma once

#include <array>
#include <vector>

#include "mesh/parallel.h"
#include "surface/complex.h"
#include "surface/search.h"

namespace holdfast {

struct DividedSpace {
  /// By facet: the region in front of it, which sees its corners turn counterclockwise, and the one behind.
  /// Region 0 is the unbounded one.
  std::vector<std::array<Index, 2>> of_facet;
  /// The unbounded one included. The others are numbered in the order of their lowest facet, in front before
  /// behind.
  Index regions = 1;
};

/// Exact. The facets of `complex` have area and meet in common vertices and sides only. Its segments, and
/// vertices without facets, divide nothing.
[[nodiscard]] DividedSpace divide_space(const Complex& complex, const Step& step, const Threads& threads = 1);

}  // namespace holdfast
