// Sheets that lie in each other but for rounding, made one.
#pragma once

#include <functional>

#include "repair/rounding.h"
#include "repair/settle.h"
#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

/// Arranges a plane surface, and rounds it. Where that moves anything further than `most`, the result may be
/// one that is not valid.
using RoundPlane = std::function<Rounded(State, double most)>;

/// Which sheets may lead a side through vertices of theirs.
enum class SidesOf {
  all_sheets,  ///< together: see SharedSides
  one_sheet,   ///< the first; others wait for the next call
};

/// Facets that overlap at a distance of at most `gap` are arranged in a projection along an axis, where they
/// overlap exactly: so sheets come to have the same triangles wherever both are, with the parents of both.
/// Vertices stay; new ones, where sides cross in the projection, get their third coordinate from a facet
/// below. Sides that are cut so are cut in all facets that have them.
///
/// The result is a graph over a triangulation of the plane and cannot cross itself; what is round it may.
struct Flattened {
  double moved = 0;      ///< the largest distance by which anything was moved or bent, rounded up
  bool has_led = false;  ///< some side: where there was none, `sides` made no difference
  /// Facets, as they are now, that changed or overlapped others: what overlaps from now on has one of them.
  std::vector<Index> changed;
};
Flattened flatten(State& state, double gap, const RoundPlane& round, SidesOf sides, const Step& step,
                  std::span<const Index> some = {});

/// The same again, as long as there is something to do, but a few times at most.
Flattened flatten_all(State& state, double gap, const RoundPlane& round, SidesOf sides, const Step& step);

}  // namespace holdfast::repairing
