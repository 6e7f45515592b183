// The mesh of one VTK XML file, and what it says of a second one beside it.
#pragma once

#include <span>
#include <vector>

#include "io/formats.h"
#include "io/vtu_file.h"

namespace holdfast::io {

struct VtuBlock {
  MeshData mesh = {};
  bool surface_beside = false;          ///< there should be a file with what bounds the tetrahedra
  std::vector<std::int64_t> in_volume;  ///< of this second file: its points' indices in the first
};

[[nodiscard]] VtuBlock read_vtu_block(const VtuFile& file);
/// The first of these arrays of the points that is there.
[[nodiscard]] PointArray point_array(const VtuFile& file, std::span<const char* const> names);

}  // namespace holdfast::io
