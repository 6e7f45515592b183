// The triangles of a COLLADA geometry.
#pragma once

#include <optional>

#include "io/dae_file.h"
#include "io/solids.h"

namespace holdfast::io {

/// What geometries have that is left out, and polygons that were cut.
struct DaeCounts {
  std::size_t lines = 0, others = 0;
  PolygonCounts polygons;
};

/// The solid of a <geometry>; nothing if it is no mesh.
[[nodiscard]] std::optional<Solid> dae_solid(const DaeFile& file, const Source& source,
                                             const DaeElement& geometry, DaeCounts& counts);

/// The name of an element, or else its id.
[[nodiscard]] std::string dae_name(const DaeElement& element);

}  // namespace holdfast::io
