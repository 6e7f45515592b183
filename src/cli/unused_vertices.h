// The vertices of a surface that belong to no triangle and no segment.
#pragma once

#include <vector>

#include "holdfast/types.h"

namespace holdfast::cli {

/// By vertex: whether it belongs to a triangle or segment.
[[nodiscard]] std::vector<bool> in_use(const Surface& surface);

/// How many vertices belong to nothing but are vertices of a mesh all the same: without those that are left
/// out, as duplicates or because they are not finite.
[[nodiscard]] std::size_t isolated_vertices(const Surface& surface);

/// The vertices of the surface, but those that belong to nothing are not finite, so that a mesh leaves them
/// out. The others keep their numbers.
[[nodiscard]] std::vector<Point> without_unused(const Surface& surface);

}  // namespace holdfast::cli
