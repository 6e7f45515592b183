// The best Q (quality.h) that any mesh can have on given triangles.
#pragma once

#include <span>

#include "holdfast/types.h"
#include "mesh/parallel.h"

namespace holdfast {

/// The least Q of all tetrahedra that have abc as a face: the best that a mesh can have there. Infinite for
/// a triangle without area. (The paper's Target is the largest of them: the worst triangle's.)
[[nodiscard]] double best_quality_on(const Point& a, const Point& b, const Point& c);

/// The Target of the paper: the largest, over all triangles, of the best Q. Zero without triangles.
[[nodiscard]] double target_quality(std::span<const Point> vertices, std::span<const Triangle> facets,
                                    const Threads& threads = 1);

}  // namespace holdfast
