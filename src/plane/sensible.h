// Checks that options make sense, alone and together.
#pragma once

#include "holdfast/plane.h"

namespace holdfast::plane {

inline constexpr std::size_t kMostPoints = std::size_t{1} << 28;

[[nodiscard]] inline bool refines(const PlaneOptions& options) { return options.size > 0 || options.angle; }

/// Throws as holdfast::triangulate documents.
void require_sensible(const Plane& plane, const PlaneOptions& options);

}  // namespace holdfast::plane
