// Shared by the readers of planes.
#pragma once

#include <string>

#include "holdfast/plane.h"
#include "io/mesh_data.h"

namespace holdfast::io {

/// In lower case, with a dot.
[[nodiscard]] std::string plane_extension_of(const std::filesystem::path& path, std::string_view format);
/// A two-dimensional .poly or .node. Throws FileError.
[[nodiscard]] Plane parse_plane(const Source& source, std::string_view extension);

}  // namespace holdfast::io
