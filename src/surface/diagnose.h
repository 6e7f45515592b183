// Surface layer: the test of a valid input (docs/concepts.md) and its diagnosis.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "holdfast/types.h"
#include "mesh/parallel.h"
#include "surface/search.h"

namespace holdfast {

/// Every broken rule of a valid input, exactly and by root cause: first of single entities, then of elements
/// that do not fit together (search.h), ordered by the least pair of elements concerned (facets before
/// segments before vertices). Empty for a valid complex.
///
/// `most` bounds the number of defects; then they are the first that turn up. `step` is called now and
/// then from the calling thread with the share of the work that is done and may throw to stop (a Monitor's
/// poll does). The result does not depend on `threads`.
///
/// Of a defect of two simplices, `facets` and `segments` hold
///   - for two facets, or a dangling segment and a facet or segment, whose interiors meet: that pair;
///   - else (a vertex in a side or facet, sides that cross, a side through a facet) all those that have the
///     containing or second simplex as a face, then all those that have the first. Each of the former
///     with each of the latter is a pair that does not fit.
[[nodiscard]] std::vector<Defect> find_defects(const Complex& complex, std::size_t most, const Step& step,
                                               const Threads& threads = 1,
                                               SamePlace same_place = SamePlace::one_vertex);

/// The same for a caller that already has the complex's elements.
[[nodiscard]] std::vector<Defect> find_defects(const Complex& complex, const Elements& elements,
                                               std::size_t most, const Step& step, const Threads& threads);

/// An element of the complex: a facet, a segment that is no facet's side, or a vertex that neither uses.
struct ElementRef {
  unsigned corners;  ///< 3: a facet, 2: a segment, 1: a vertex
  Index id;          ///< of the facet, segment or vertex

  friend bool operator==(const ElementRef&, const ElementRef&) = default;
};

/// Every pair of elements that neither meet in a common face nor are disjoint. An all-pairs test would find
/// the same pairs, after vertices at one place are identified and facets of zero area are left out. Ordered:
/// facets before segments before vertices. The number may be quadratic: `most` bounds it.
[[nodiscard]] std::vector<std::array<ElementRef, 2>> offending_pairs(const Complex& complex, std::size_t most,
                                                                     const Step& step);

}  // namespace holdfast
