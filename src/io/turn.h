// Tetrahedra that a program turned the other way than the format says.
#pragma once

#include <string>

#include "io/mesh_data.h"

namespace holdfast::io {

/// Turns all tetrahedra, and says `remark`, where all of them are negative: some programs (meshio) write them
/// so. Where only some are, the file is as wrong as it stands.
void turn_if_all_are_turned(MeshData& mesh, const std::string& remark);

/// Whether the volume of a tetrahedron is negative in plain arithmetic: nothing of the topology depends on
/// it.
[[nodiscard]] bool is_turned(const Tetrahedron& t, const std::vector<Point>& vertices);

}  // namespace holdfast::io
