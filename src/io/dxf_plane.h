// The plane of an entity of a DXF file.
#pragma once

#include "io/dxf_text.h"
#include "io/placement.h"

namespace holdfast::io {

/// From the coordinates of an entity's plane, by the normal in 210 to 230 ("Arbitrary axis algorithm").
[[nodiscard]] Placement placement_of_plane(DxfText& text, const DxfEntity& entity);

}  // namespace holdfast::io
