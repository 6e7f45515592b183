// Meshes of Ansys Fluent.
#pragma once

#include <string_view>

namespace holdfast::io {

/// Faces on the boundary that no facet marks are in a zone of a name like this, as in OpenFOAM.
inline constexpr std::string_view kRestOfFluent = "defaultFaces";

/// Whether a file begins with a section of Fluent's.
[[nodiscard]] bool is_fluent(std::string_view bytes);

}  // namespace holdfast::io
