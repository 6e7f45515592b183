// What the readers of TetGen's files share: vertices, and the files that lie beside one another.
#pragma once

#include "io/text_reader.h"

namespace holdfast::io {

/// Vertices of a .node file or section, and the number of the first: 0 or 1.
struct TetgenNodes {
  std::vector<Point> vertices;
  Tags markers;
  std::size_t attributes = 0;  ///< numbers a vertex that have no place in a mesh
  std::int64_t base = 0;
};

/// Reads "count dimension attributes markers" and the vertices. A count of 0 leaves them empty.
[[nodiscard]] TetgenNodes read_tetgen_nodes(TextReader& text);

/// Reads the .node file beside the source, whose own bytes are not used. Throws FileError.
[[nodiscard]] TetgenNodes read_tetgen_node_file(const Source& source);

/// Moves the vertices and their markers.
void take_nodes(MeshData& mesh, TetgenNodes& nodes);

/// A number at the start of a line that counts up from `base`; throws if it is another.
void read_tetgen_number(TextReader& text, const char* what, std::int64_t expected);

}  // namespace holdfast::io
