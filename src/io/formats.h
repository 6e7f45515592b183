// The readers and writers, one pair a format, and the table that finds them by extension.
#pragma once

#include <span>

#include "io/atomic_writer.h"
#include "io/mesh_data.h"

namespace holdfast::io {

[[nodiscard]] MeshData read_off(const Source& source);
[[nodiscard]] MeshData read_medit(const Source& source);

void write_medit(AtomicWriter& out, const Volume& volume);
void write_vtk(AtomicWriter& out, const Volume& volume);
void write_vtu(AtomicWriter& out, const Volume& volume, const WriteOptions& options);

/// Parses bytes as the format of that extension (".off"). Throws FileError.
[[nodiscard]] MeshData parse(const Source& source, std::string_view format);

/// The tag of entity `i`, 0 where there are none.
[[nodiscard]] inline int tag_of(const std::vector<int>& tags, std::size_t i) {
  return tags.empty() ? 0 : tags[i];
}

}  // namespace holdfast::io
