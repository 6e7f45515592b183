// Holdfast: writes files in TetGen's formats.
#pragma once

#include "holdfast/holdfast.h"
#include "holdfast/io.h"

namespace holdfast {

/// Which of TetGen's files to write, and what is in them.
struct TetgenFiles : Limits {
  int first = 0;            ///< number of the first vertex, tetrahedron, face and edge: 0 or 1
  bool nodes = true;        ///< .node
  bool elements = true;     ///< .ele
  bool faces = true;        ///< .face: the facets
  bool edges = true;        ///< .edge: segments, and the sides of facets
  bool markers = true;      ///< boundary markers in .node and .face
  bool attributes = false;  ///< region ids in .ele
  bool all_faces = false;   ///< .face: also faces that are not facets, with marker 0
  bool all_edges = false;   ///< .edge: also edges that are not segments or sides of facets, with marker 0
  bool neighbours = false;  ///< .neigh
  bool adjacent = false;    ///< .face: the tetrahedra on both sides; .edge: one tetrahedron at the edge
  bool surface = false;     ///< .smesh: the facets
  std::string comment;      ///< the last line of each file, after "# "; without line breaks
  ProgressFunction progress = {};
};

/// The files that `write_tetgen` writes for NAME: NAME.node and so on.
[[nodiscard]] HOLDFAST_API std::vector<std::filesystem::path> files_of_tetgen(
    const std::filesystem::path& name, const TetgenFiles& files);

/// Writes NAME.node, NAME.ele, NAME.face, NAME.edge, NAME.neigh and NAME.smesh, all of them or none. Mid-edge
/// nodes, if there are any, come in TetGen's order (edges 23 03 01 12 13 02). Facets and edges without
/// markers get 1. Numbers read back bit for bit. Throws FileError, std::invalid_argument for arrays that do
/// not fit, and Interrupted.
HOLDFAST_API void write_tetgen(const std::filesystem::path& name, const Volume& volume,
                               const TetgenFiles& files = {});

/// Adds the triangles of the convex hull of all vertices that are not facets yet. They fit the surface: sides
/// of facets and segments on the hull are kept. Their markers are 0. Returns the number of triangles added.
/// If the surface breaks a rule, its hull may not fit it. Throws std::invalid_argument for coordinates that
/// are not finite and indices out of range, and Interrupted; the surface is then unchanged.
HOLDFAST_API std::size_t add_convex_hull(Surface& surface, const Limits& limits = {});

/// The number that TetGen gives the first vertex of a file: the file's own for .node, .poly and .smesh, 1 for
/// .mesh, .meshb and .stl, 0 for other formats and for files that cannot be read.
[[nodiscard]] HOLDFAST_API int tetgen_first_number(const std::filesystem::path& path);

}  // namespace holdfast
