// Parts of the search that pay seldom, and are taken back where they do not: other meshes round the worst
// elements, and points.
#pragma once

#include "optimise/search.h"

namespace holdfast {

/// The worst that is left may go from another mesh round it, made by random flips.
void shake_the_worst(Search& search);

/// What has nothing else left gets points. They stay if they are worth it. Returns whether they were tried
/// and do; then the worst that was left has been shaken, too.
bool try_with_points(Search& search);

/// Removes the points from this one on that the mesh can do without now, as long as nothing comes of it that
/// is worth a point.
void remove_points(Search& search, std::size_t from);

}  // namespace holdfast
