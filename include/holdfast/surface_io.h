// Holdfast: writing surfaces.
#pragma once

#include "holdfast/io.h"

namespace holdfast {

/// Writes a surface to a temporary name and renames the file, so that no partial file is ever left. Throws
/// Interrupted for its limits, FileError, and std::invalid_argument if there are not as many markers as
/// entities, or if an index is not that of a vertex.
///
/// .off, .obj (a group for each marker), .stl (ASCII, a solid for each marker), .ply (ASCII), .poly, .mesh,
/// .meshb (GMF), .msh (ASCII), .vtk, .vtu; lengths in the surface's own unit. Coordinates read back bit for
/// bit. Vertices and facets keep their order and indices, except in .stl, which has neither, and in .msh 4.1,
/// which groups facets by marker. `not_held` lists what the format cannot hold.
HOLDFAST_API void write_surface(const std::filesystem::path& path, const Surface& surface,
                                const WriteOptions& options = {});

/// What a file of `write_surface` does not hold of a surface: markers (.off), segments
/// (.stl, .ply), vertices without facets (.stl), seeds (all but .poly).
[[nodiscard]] HOLDFAST_API std::vector<Remark> not_held(const std::filesystem::path& path,
                                                        const Surface& surface,
                                                        const WriteOptions& options = {});

/// Extensions that `write_surface` knows, with the dot, in lower case.
[[nodiscard]] HOLDFAST_API std::vector<std::string> surface_formats();

}  // namespace holdfast
