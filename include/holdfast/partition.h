// Holdfast: a volume in pieces, for solvers that run as several processes (docs/partitions.md).
#pragma once

#include <functional>

#include "holdfast/divide.h"
#include "holdfast/export.h"
#include "holdfast/io.h"
#include "holdfast/types.h"

namespace holdfast {

/// Whether this library was built with METIS, which `partition` needs.
[[nodiscard]] HOLDFAST_API bool has_metis();

/// The part, from 0, of each tetrahedron. Parts have about equal numbers of tetrahedra and few faces between
/// them. METIS runs with a fixed seed, so the same volume gives the same parts. No part is empty. Throws
/// std::invalid_argument for no parts, for more parts than tetrahedra, and for more than METIS can number;
/// std::runtime_error without METIS.
[[nodiscard]] HOLDFAST_API std::vector<Index> partition(const Volume& volume, std::size_t parts);

/// The piece of a volume that one process holds: its own tetrahedra, and a layer of ghosts, the tetrahedra of
/// other parts that share a vertex with them.
struct MeshPiece {
  /// Own tetrahedra first, then ghosts; vertices of own tetrahedra first, then those of ghosts alone, each in
  /// the order of the whole. Facets and segments are those on own tetrahedra. Piece 0 also has everything on
  /// no tetrahedron. Elements are of first order.
  Volume volume;
  std::size_t own_tetrahedra = 0, own_vertices = 0;
  std::vector<std::uint64_t> vertices;    ///< their numbers in the whole
  std::vector<std::uint64_t> tetrahedra;  ///< their numbers in the whole
  std::vector<Index> owners;              ///< the part of each tetrahedron
  /// The lowest part whose own tetrahedra have the vertex, facet or segment.
  std::vector<Index> vertex_owners, facet_owners, segment_owners;

  /// Faces between own tetrahedra and those of another part. Both parts list them in the same order: by their
  /// vertices' numbers in the whole.
  struct Interface {
    Index other;
    std::vector<Triangle> faces;  ///< oriented outwards from the own tetrahedron, the lowest number first
  };
  std::vector<Interface> interfaces;  ///< by the other part
};

/// Returns piece k. May be called several times for each piece.
using PieceLoader = std::function<MeshPiece(std::size_t)>;

/// The pieces of a volume, which must outlive the loader. Throws std::invalid_argument unless `part_of` has a
/// part below `parts` for each tetrahedron, for a volume of second order, and for a volume with a face of
/// more than two tetrahedra.
[[nodiscard]] HOLDFAST_API PieceLoader pieces_of(const Volume& volume, std::vector<Index> part_of,
                                                 std::size_t parts);

/// The parts of a divided surface (divide.h), unchanged, as pieces of the volume that `join_parts` returns.
/// Tetrahedra are numbered part by part. Memory held between calls grows with the surface and the
/// interfaces.
[[nodiscard]] HOLDFAST_API PieceLoader joined_pieces(const Complex& surface, std::size_t parts,
                                                     const PartLoader& load, int interface_marker);

/// Writes pieces for parallel solvers, with one piece in memory at a time if the format allows.
///
/// - .pvtu: NAME.pvtu and for each piece NAME_k.vtu, with vtkGhostType, the numbers in the whole, and the
///   interfaces as arrays of the grid; facets and segments in NAME_k_surface.vtu, which NAME_surface.pvtu
///   lists.
/// - .msh (4.1): one file with an entity for each part of a group and for each two parts with common faces,
///   and with ghost elements.
/// - .xdmf: one mesh with its cells by part, and NAME.h5 with `part`, `ghost_offsets`, `ghosts` and
///   `interfaces` (docs/partitions.md). Holds the whole in memory.
/// - .openfoam: processork/constant/polyMesh in the case, with a patch for each interface.
/// Each file appears when it is complete, the .pvtu last. Throws as `write_volume` does.
HOLDFAST_API void write_pieces(const std::filesystem::path& path, std::size_t parts, const PieceLoader& load,
                               const WriteOptions& options = {});

/// The formats that `write_pieces` knows.
[[nodiscard]] HOLDFAST_API std::vector<std::string> piece_formats();

/// The files that `write_pieces` writes.
[[nodiscard]] HOLDFAST_API std::vector<std::filesystem::path> files_of_pieces(
    const std::filesystem::path& path, std::size_t parts, std::string_view format = {});

}  // namespace holdfast
