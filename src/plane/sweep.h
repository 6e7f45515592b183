// A sweep over points and segments: whether they are valid, and how their parts are linked to each other.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "plane/points.h"
#include "plane/triangles.h"

namespace holdfast::plane {

using Ends = std::array<Vertex, 2>;

/// Links between the parts of the segments' graph, isolated points among them: each cuts neither segments nor
/// other links, and within each bounded face all that is there hangs together by segments and links. Nothing
/// where points are at one place, or segments meet other than in common ends (Shamos, Hoey 1976). Points
/// stand from left to right (sorted.h).
[[nodiscard]] std::optional<std::vector<Ends>> sweep(const Points& points, const std::vector<Ends>& segments,
                                                     const Poll& poll);

}  // namespace holdfast::plane
