// Reads VRML 1.0 and 2.0 (VRML97), and X3D in XML: the indexed face sets that the scene places.
#pragma once

#include "io/mesh_data.h"

namespace holdfast::io {

[[nodiscard]] MeshData read_vrml(const Source& source);

}  // namespace holdfast::io
