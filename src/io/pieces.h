// Writers of volumes in pieces, one for each format.
#pragma once

#include "holdfast/partition.h"
#include "io/atomic_writer.h"

namespace holdfast::io {

/// The faces between a piece and others, in the fields of its .vtu.
inline constexpr const char* kInterfaces = "holdfast:interfaces";

void write_pvtu(const std::filesystem::path& path, std::size_t parts, const PieceLoader& load,
                const WriteOptions& options, Watch& watch);
/// NAME_k.vtu.
[[nodiscard]] std::filesystem::path pvtu_piece(const std::filesystem::path& path, std::size_t k);

void write_msh_pieces(const std::filesystem::path& path, std::size_t parts, const PieceLoader& load,
                      const WriteOptions& options, Watch& watch);

/// One mesh, whose cells are ordered by part.
void write_xdmf_pieces(const std::filesystem::path& path, std::size_t parts, const PieceLoader& load,
                       const WriteOptions& options, Watch& watch);

/// Writes processork/constant/polyMesh into a case.
void write_processors(const std::filesystem::path& path, std::size_t parts, const PieceLoader& load,
                      const WriteOptions& options, Watch& watch);
/// The polyMesh of process k in the case that the path names, in the sense of `poly_mesh_of`.
[[nodiscard]] std::filesystem::path processor_mesh(const std::filesystem::path& path, std::size_t k);

}  // namespace holdfast::io
