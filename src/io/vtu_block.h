// The mesh of one VTK XML file, and what it says of a second one beside it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "io/formats.h"
#include "io/vtu_file.h"

namespace holdfast::io {

/// Cells of other processes, which a piece has copies of.
enum class VtuGhosts { kept, left_out };

/// Arrays of ids in the whole, of which a file is a piece: ours, and ParaView's and Exodus'.
inline constexpr std::array<const char*, 4> kPointIds{"vertex", "GlobalPointIds", "GlobalNodeIds",
                                                      "GlobalNodeId"};
inline constexpr std::array<const char*, 3> kCellIds{"tetrahedron", "GlobalCellIds", "GlobalElementId"};

struct VtuBlock {
  MeshData mesh = {};
  /// Of a piece of a whole: ids of its points, and of its tetrahedra where every cell is one; empty where the
  /// file has none.
  std::vector<std::int64_t> point_ids = {}, tetrahedron_ids = {};
  bool surface_beside = false;          ///< there should be a file with what bounds the tetrahedra
  std::vector<std::int64_t> in_volume;  ///< of this second file: its points' indices in the first
};

[[nodiscard]] VtuBlock read_vtu_block(const VtuFile& file, VtuGhosts ghosts = VtuGhosts::kept);
/// With what is in the file beside it, if it says that there is one.
[[nodiscard]] VtuBlock read_vtu_blocks(const Source& source, VtuGhosts ghosts = VtuGhosts::kept);
/// Appends the entities of a part, whose vertex i is `number[i]` of the mesh.
void append(MeshData& mesh, MeshData&& part, const std::vector<Index>& number);
/// The first of these arrays of the points that is there.
[[nodiscard]] PointArray point_array(const VtuFile& file, std::span<const char* const> names);

}  // namespace holdfast::io
