// The reader of 3D Studio's files.
#pragma once

#include "io/mesh_data.h"

namespace holdfast::io {

[[nodiscard]] MeshData read_3ds(const Source& source);

}  // namespace holdfast::io
