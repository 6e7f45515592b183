// Steps of the search that seldom pay, and are undone if they do not: other meshes round the worst elements,
// and points.
#pragma once

#include "optimise/search.h"

namespace holdfast {

/// Random flips make another mesh round the worst element left, from which it may be removable.
void shake_the_worst(Search& search);

/// Elements that nothing else helps get points, which stay if they are worth it. Returns whether points were
/// tried and stay; the worst element left has then been shaken, too.
bool try_with_points(Search& search);

/// Removes points from this one on that the mesh no longer needs, unless the removal leaves an element that
/// is worth a point.
void remove_points(Search& search, std::size_t from);

}  // namespace holdfast
