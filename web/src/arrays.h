// Arrays between JavaScript and the library: each is a file of little-endian numbers in the module's file
// system.
#pragma once

#include "holdfast/types.h"
#include "request.h"

namespace holdfast::web {

/// Where they stand. JavaScript empties it before each call.
inline constexpr const char* kArrays = "/arrays/";

/// Names: "vertices" (float64, 3 a row), "triangles" (uint32, 3), "segments" (uint32, 2), and
/// "triangle_markers", "segment_markers", "vertex_markers" (int32); "names" of the request has those of ids,
/// "seeds" has holes and regions. Throws std::invalid_argument for sizes that do not fit.
[[nodiscard]] Surface surface_of_arrays(const Json& request);
/// The same, and "tetrahedra" (uint32, 4), "regions" (int32) and "input_vertices" (int32, -1: an added one).
/// Indices must be in range.
[[nodiscard]] Volume volume_of_arrays(const Json& request);

/// Throws std::invalid_argument for indices that no vertex has, and markers of another number than their
/// entities.
void require_whole(const Surface& surface);

/// Writes the arrays that are not empty, and "names" and "seeds" of the response.
void give(const Surface& surface, Json& response);
void give(const Volume& volume, Json& response);

}  // namespace holdfast::web
