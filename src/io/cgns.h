// Shared by the reader and the writer of CGNS files.
#pragma once

namespace holdfast::io {

/// The descriptor in which our files keep the id and the name of what a section or a boundary condition has:
/// "surface 3 inlet".
inline constexpr const char* kCgnsId = "holdfast id";

}  // namespace holdfast::io
