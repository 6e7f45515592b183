// A sweep over points and segments: whether they are valid, and how their parts are linked to each other.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "plane/points.h"
#include "plane/triangles.h"

namespace holdfast::plane {

using Ends = std::array<Vertex, 2>;

/// Links between the parts of the segments' graph, including isolated points: no link cuts a segment or
/// another link, and within each bounded face everything is connected by segments and links. Returns nullopt
/// if points coincide, or segments meet other than in common ends (Shamos, Hoey 1976). Points are sorted from
/// left to right (sorted.h).
[[nodiscard]] std::optional<std::vector<Ends>> sweep(const Points& points, const std::vector<Ends>& segments,
                                                     const Poll& poll);

}  // namespace holdfast::plane
