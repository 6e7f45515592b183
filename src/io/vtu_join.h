// Joins pieces in VTK's XML formats, separate files or parts of one, into one mesh. Points are identified by
// their ids in the whole, or by their places if they have no ids.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/vtu_block.h"

namespace holdfast::io {

struct VtuPiece {
  std::filesystem::path path;
  std::string told_as;  ///< prefix of remarks about the piece
  VtuBlock block;
  std::vector<Index> number = {};  ///< by vertex, its number in the whole
};

/// Takes the meshes of the pieces and numbers their vertices.
[[nodiscard]] MeshData joined(std::vector<VtuPiece>& pieces);

}  // namespace holdfast::io
