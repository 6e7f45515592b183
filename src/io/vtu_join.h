// One mesh of pieces in VTK's XML formats, be they files or parts of one: points are joined by their ids in
// the whole, or by their places where they have none.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/vtu_block.h"

namespace holdfast::io {

struct VtuPiece {
  std::filesystem::path path;
  std::string told_as;  ///< what remarks about it begin with
  VtuBlock block;
  std::vector<Index> number = {};  ///< of its vertices in the whole
};

/// Takes the meshes of the pieces, and numbers their vertices.
[[nodiscard]] MeshData joined(std::vector<VtuPiece>& pieces);

}  // namespace holdfast::io
