// Tetrahedra with the orientation opposite to the format's.
#pragma once

#include <string>

#include "io/mesh_data.h"

namespace holdfast::io {

/// If all tetrahedra are negative, as some programs (meshio) write them, reverses all and adds `remark`. If
/// only some are negative, the file is wrong and stays as it is.
void turn_if_all_are_turned(MeshData& mesh, const std::string& remark);

/// For formats in which programs follow VTK's order, or none: FreeCAD writes all tetrahedra the other way
/// round, and legacy DOLFIN lists the corners of each by their numbers. If neighbours are oriented
/// differently, and fit once the negative tetrahedra are reversed, the order of the corners says nothing, and
/// these are reversed. A tangled mesh, whose neighbours fit as they are, stays.
void turn_to_vtk(MeshData& mesh);

/// Whether the volume of a tetrahedron is negative, by its exact sign: a mesh of tetrahedra that are flat to
/// the last bits must not be reversed. False if a corner is not finite.
[[nodiscard]] bool is_turned(const Tetrahedron& t, const std::vector<Point>& vertices);

}  // namespace holdfast::io
