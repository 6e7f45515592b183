// What the readers of planes share.
#pragma once

#include <string>

#include "holdfast/plane.h"
#include "io/mesh_data.h"

namespace holdfast::io {

/// In lower case, with a dot.
[[nodiscard]] std::string plane_extension_of(const std::filesystem::path& path, std::string_view format);
/// A .poly or .node of two dimensions. Throws FileError.
[[nodiscard]] Plane parse_plane(const Source& source, std::string_view extension);

}  // namespace holdfast::io
