// Makes sheets that coincide up to rounding one.
#pragma once

#include <functional>

#include "repair/clusters.h"
#include "repair/rounding.h"
#include "repair/settle.h"
#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

/// Arranges a plane surface and rounds it. If this moves anything further than `most`, the result may be
/// invalid.
using RoundPlane = std::function<Rounded(State, double most)>;

/// Which sheets may lead a side through their vertices.
enum class SidesOf {
  all_sheets,  ///< together: see SharedSides
  one_sheet,   ///< the first one; others wait for the next call
};

/// Facets that overlap at a distance of at most `gap` are arranged in a projection along an axis, where they
/// overlap exactly. So two sheets get the same triangles where both are, with the parents of both. Vertices
/// stay. New vertices, where sides cross in the projection, get their third coordinate from a facet below
/// them. A side that is cut is cut in all of its facets.
///
/// The result is a graph over a triangulation of the plane, so it cannot cross itself. It may cross the
/// surface round it.
struct Flattened {
  double moved = 0;         ///< the largest distance by which anything was moved or bent, rounded up
  bool has_shared = false;  ///< whether several sheets had a led side; if not, `sides` made no difference
  /// Facets, by their present numbers, that changed or overlapped others. Any overlap from now on involves
  /// one of them.
  std::vector<Index> changed;
};
Flattened flatten(State& state, double gap, const RoundPlane& round, SidesOf sides, const Step& step,
                  std::span<const Index> some = {});

/// Repeats `flatten` while it changes something, a few times at most. `clusters`: those of the whole state.
Flattened flatten_all(State& state, const Clusters& clusters, double gap, const RoundPlane& round,
                      SidesOf sides, const Step& step);
Flattened flatten_all(State& state, double gap, const RoundPlane& round, SidesOf sides, const Step& step);

}  // namespace holdfast::repairing
