// The reader of AC3D's files.
#pragma once

#include "io/mesh_data.h"

namespace holdfast::io {

[[nodiscard]] MeshData read_ac3d(const Source& source);

}  // namespace holdfast::io
