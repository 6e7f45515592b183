// The mesh of one VTK XML file, and what the file says about a second one beside it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "io/formats.h"
#include "io/vtu_file.h"

namespace holdfast::io {

/// Cells of other processes, of which a piece has copies.
enum class VtuGhosts { kept, left_out };

/// Arrays of ids in the whole mesh of which a file is a piece: ours, and those of ParaView and Exodus.
inline constexpr std::array<const char*, 4> kPointIds{"vertex", "GlobalPointIds", "GlobalNodeIds",
                                                      "GlobalNodeId"};
inline constexpr std::array<const char*, 3> kCellIds{"tetrahedron", "GlobalCellIds", "GlobalElementId"};

struct VtuBlock {
  MeshData mesh = {};
  /// For a piece of a whole: ids of its points, and of its tetrahedra if all cells are tetrahedra; empty if
  /// the file has none.
  std::vector<std::int64_t> point_ids = {}, tetrahedron_ids = {};
  bool surface_beside = false;          ///< a file with the boundary of the tetrahedra should exist
  std::vector<std::int64_t> in_volume;  ///< for this second file: its points' indices in the first
};

[[nodiscard]] VtuBlock read_vtu_block(const VtuFile& file, VtuGhosts ghosts = VtuGhosts::kept);
/// Includes the content of the file beside it, if the file says that there is one.
[[nodiscard]] VtuBlock read_vtu_blocks(const Source& source, VtuGhosts ghosts = VtuGhosts::kept);
/// Appends the entities of a part; vertex i of the part is vertex `number[i]` of the mesh.
void append(MeshData& mesh, MeshData&& part, const std::vector<Index>& number);
/// The first of these point arrays that exists.
[[nodiscard]] PointArray point_array(const VtuFile& file, std::span<const char* const> names);

}  // namespace holdfast::io
