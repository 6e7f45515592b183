// Shared by the readers of TetGen's files: vertices, and files that lie beside each other.
#pragma once

#include "io/text_reader.h"

namespace holdfast::io {

/// The vertices of a .node file or section, and the number of the first: 0 or 1.
struct TetgenNodes {
  std::vector<Point> vertices;
  Tags markers;
  std::size_t attributes = 0;  ///< numbers per vertex that a mesh cannot store
  std::int64_t base = 0;
};

/// Reads "count dimension attributes markers" and the vertices. If the count is 0, there are none.
[[nodiscard]] TetgenNodes read_tetgen_nodes(TextReader& text);

/// Reads the .node file beside the source. The source's own bytes are not used. Throws FileError.
[[nodiscard]] TetgenNodes read_tetgen_node_file(const Source& source);

/// Moves the vertices and their markers.
void take_nodes(MeshData& mesh, TetgenNodes& nodes);

/// Reads a line's number, which must count up from `base`; throws if it is a different one.
void read_tetgen_number(TextReader& text, const char* what, std::int64_t expected);

}  // namespace holdfast::io
