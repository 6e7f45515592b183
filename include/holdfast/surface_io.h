// Holdfast: writing surfaces.
#pragma once

#include "holdfast/io.h"

namespace holdfast {

/// Writes a surface beside its name and renames it, so that no partial file is ever left. Throws Interrupted
/// for its limits, FileError, and std::invalid_argument for markers of another number than their entities.
///
/// .off, .obj (a group for each marker), .stl (ASCII, a solid for each marker), .ply (ASCII), .poly, .mesh,
/// .meshb (GMF), .msh (ASCII), .vtk, .vtu; lengths in the surface's own unit. Coordinates read back bit for
/// bit. Vertices and facets keep their order and indices, but for .stl, which has neither, and .msh 4.1,
/// which groups facets by marker. What the format does not hold, `not_held` says.
HOLDFAST_API void write_surface(const std::filesystem::path& path, const Surface& surface,
                                const WriteOptions& options = {});

/// What of a surface the file that `write_surface` writes does not hold: markers (.off), segments
/// (.stl, .ply), vertices without facets (.stl), seeds (all but .poly).
[[nodiscard]] HOLDFAST_API std::vector<Remark> not_held(const std::filesystem::path& path,
                                                        const Surface& surface,
                                                        const WriteOptions& options = {});

/// Extensions that `write_surface` knows, with the dot, in lower case.
[[nodiscard]] HOLDFAST_API std::vector<std::string> surface_formats();

}  // namespace holdfast
