// The readers and writers, one pair a format, and the table that finds them by extension.
#pragma once

#include <span>

#include "io/atomic_writer.h"
#include "io/mesh_data.h"

namespace holdfast::io {

[[nodiscard]] MeshData read_off(const Source& source);
[[nodiscard]] MeshData read_stl(const Source& source);
[[nodiscard]] MeshData read_obj(const Source& source);
[[nodiscard]] MeshData read_ply(const Source& source);
[[nodiscard]] MeshData read_poly(const Source& source);
[[nodiscard]] MeshData read_smesh(const Source& source);
/// The vertices of a .node file alone.
[[nodiscard]] MeshData read_node(const Source& source);
[[nodiscard]] MeshData read_xyz(const Source& source);
/// The .node, .ele, .face and .edge files beside the source, whose own bytes are not used.
[[nodiscard]] MeshData read_tetgen_volume(const Source& source);
[[nodiscard]] MeshData read_medit(const Source& source);

[[nodiscard]] MeshData read_gmf(const Source& source);
/// Numbers at the vertices of a mesh in another file.
struct GmfSolution {
  std::size_t vertices = 0;
  std::size_t columns = 0;     ///< 1: scalars, 6: symmetric tensors
  std::vector<double> values;  ///< of all columns, vertex by vertex
};
/// The one scalar or symmetric tensor a vertex of a .solb.
[[nodiscard]] GmfSolution read_gmf_solution(const Source& source);
[[nodiscard]] MeshData read_msh(const Source& source);
[[nodiscard]] MeshData read_vtk(const Source& source);
[[nodiscard]] MeshData read_vtu(const Source& source);
/// Numbers at the points of a grid, the components of each one together.
struct PointArray {
  std::size_t components = 1;
  std::vector<double> values;
};
/// The same; `array` gets the first of these point arrays that is there. Throws FileError without any.
[[nodiscard]] MeshData read_vtu(const Source& source, std::span<const char* const> names, PointArray& array);

void write_medit(AtomicWriter& out, const Volume& volume);
void write_msh(AtomicWriter& out, const Volume& volume, const WriteOptions& options);
/// Writes .node, .ele, .face and .edge beside `path`.
void write_tetgen(const std::filesystem::path& path, const Volume& volume, Watch* watch = nullptr);
void write_gmf(AtomicWriter& out, const Volume& volume);
void write_vtk(AtomicWriter& out, const Volume& volume);
void write_vtu(AtomicWriter& out, const Volume& volume, const WriteOptions& options);

/// Parses bytes as the format of an extension such as ".off", or else of the path's own. Throws
/// FileError.
[[nodiscard]] MeshData parse_surface(const Source& source, std::string_view format = {});
[[nodiscard]] MeshData parse_volume(const Source& source, std::string_view format = {});

}  // namespace holdfast::io
