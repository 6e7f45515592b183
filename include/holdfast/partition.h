// Holdfast: a volume in pieces for solvers that run as many processes (docs/partitions.md).
#pragma once

#include <functional>

#include "holdfast/divide.h"
#include "holdfast/export.h"
#include "holdfast/io.h"
#include "holdfast/types.h"

namespace holdfast {

/// Whether this library was built with METIS, which `partition` needs.
[[nodiscard]] HOLDFAST_API bool has_metis();

/// The part, from 0, of each tetrahedron: parts of about equal numbers of tetrahedra with few faces between
/// them, by METIS with a fixed seed, so that the same volume gives the same parts. No part is empty. Throws
/// std::invalid_argument for no parts, for more than there are tetrahedra, and for more than METIS numbers;
/// std::runtime_error without METIS.
[[nodiscard]] HOLDFAST_API std::vector<Index> partition(const Volume& volume, std::size_t parts);

/// What one process has of a volume: its own tetrahedra, and a layer of ghosts, the tetrahedra of other parts
/// that share a vertex with them.
struct MeshPiece {
  /// Own tetrahedra first, then ghosts; vertices of own tetrahedra first, then those of ghosts alone, each in
  /// the order of the whole. Facets and segments are those on own tetrahedra. What is on no tetrahedron is in
  /// piece 0. Of first order.
  Volume volume;
  std::size_t own_tetrahedra = 0, own_vertices = 0;
  std::vector<std::uint64_t> vertices;    ///< their numbers in the whole
  std::vector<std::uint64_t> tetrahedra;  ///< their numbers in the whole
  std::vector<Index> owners;              ///< the part of each tetrahedron
  /// The least of the parts whose own tetrahedra have the vertex, facet or segment.
  std::vector<Index> vertex_owners, facet_owners, segment_owners;

  /// Faces between own tetrahedra and those of another part, in an order that both have: by their vertices'
  /// numbers in the whole.
  struct Interface {
    Index other;
    std::vector<Triangle> faces;  ///< seen from outside the own tetrahedron, the least number first
  };
  std::vector<Interface> interfaces;  ///< by the other part
};

/// Gives piece k; may be called several times for each.
using PieceLoader = std::function<MeshPiece(std::size_t)>;

/// The pieces of a volume, which must outlive the loader. Throws std::invalid_argument unless `part_of` has a
/// part below `parts` for each tetrahedron, for a volume of second order, and for one with a face of more
/// than two tetrahedra.
[[nodiscard]] HOLDFAST_API PieceLoader pieces_of(const Volume& volume, std::vector<Index> part_of,
                                                 std::size_t parts);

/// The parts of a divided surface (divide.h) as pieces of the volume that `join_parts` gives, each as it is.
/// Tetrahedra count on from part to part. What is held between calls goes with the surface and the
/// interfaces.
[[nodiscard]] HOLDFAST_API PieceLoader joined_pieces(const Complex& surface, std::size_t parts,
                                                     const PartLoader& load, int interface_marker);

/// Writes pieces as solvers of many processes read them, one piece in memory at a time where the format lets
/// it.
///
/// - .pvtu: NAME.pvtu and a NAME_k.vtu a piece with vtkGhostType, the whole's numbers, and the interfaces as
///   arrays of the grid; facets and segments in NAME_k_surface.vtu, of which NAME_surface.pvtu knows.
/// - .msh (4.1): one file with an entity for each part of a group and for each two parts that have faces in
///   common, and with ghost elements.
/// - .xdmf: one mesh with its cells by part, and NAME.h5 with `part`, `ghost_offsets`, `ghosts` and
///   `interfaces` (docs/partitions.md). In memory as a whole.
/// - .openfoam: processork/constant/polyMesh in the case, with a patch for each interface.
/// Each file appears when it is complete; the .pvtu last. Throws as `write_volume` does.
HOLDFAST_API void write_pieces(const std::filesystem::path& path, std::size_t parts, const PieceLoader& load,
                               const WriteOptions& options = {});

/// The formats that `write_pieces` knows.
[[nodiscard]] HOLDFAST_API std::vector<std::string> piece_formats();

/// The files that `write_pieces` writes.
[[nodiscard]] HOLDFAST_API std::vector<std::filesystem::path> files_of_pieces(
    const std::filesystem::path& path, std::size_t parts, std::string_view format = {});

}  // namespace holdfast
