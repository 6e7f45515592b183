// Readers of surfaces that programs for brain images write.
#pragma once

#include "io/mesh_data.h"

namespace holdfast::io {

/// GIFTI.
[[nodiscard]] MeshData read_gifti(const Source& source);
/// FreeSurfer's own files.
[[nodiscard]] MeshData read_freesurfer(const Source& source);

}  // namespace holdfast::io
