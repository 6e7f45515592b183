// The files that belong to a name: TetGen, glTF and Abaqus use several, and so does a mesh with its sizes.
#include <algorithm>
#include <fstream>
#include <string>
#include <system_error>

#include "holdfast/io.h"
#include "io/endings.h"
#include "io/file_bytes.h"
#include "io/formats.h"
#include "io/text_reader.h"

namespace holdfast {
namespace {

using Paths = std::vector<std::filesystem::path>;

std::string packed_extension_of(const std::filesystem::path& path, std::string_view format) {
  std::string extension =
      io::lower(format.empty() ? io::without_gz(path).extension().string() : std::string(format));
  if (!extension.empty() && extension[0] != '.') extension.insert(0, 1, '.');
  return io::usual_ending(std::move(extension));
}

/// Whether the vertices are in a separate .node file: then the first number, their count, is 0.
bool has_nodes_beside(const std::filesystem::path& path) {
  std::error_code error;
  // A pipe can only be read once, and unpacking a file for this is not worth it.
  if (!std::filesystem::is_regular_file(path, error) || io::without_gz(path) != path) return true;
  std::ifstream file(path, std::ios::binary);
  for (std::string line; std::getline(file, line);) {
    const std::size_t start = line.find_first_not_of(" \t\r");
    if (start == std::string::npos || line[start] == '#') continue;
    const std::size_t digit = line.find_first_not_of('0', start);
    return digit != start && (digit == std::string::npos || line[digit] < '0' || line[digit] > '9');
  }
  return false;
}

Paths tetgen_files(const std::filesystem::path& path) {
  return {io::sibling(path, ".node"), io::sibling(path, ".ele"), io::sibling(path, ".face"),
          io::sibling(path, ".edge")};
}

}  // namespace

Paths files_of_surface(const std::filesystem::path& path, std::string_view format) {
  const std::string extension = packed_extension_of(path, format);
  for (const std::string_view of_several :
       {".vtu", ".pvtu", ".pvtp", ".pvd", ".vtm", ".xdmf", ".openfoam", ".case", ""})
    if (extension == of_several) return files_of_volume(path, format);
  if ((extension == ".poly" || extension == ".smesh") && has_nodes_beside(path))
    return {path, io::sibling(path, ".node")};
  if (extension == ".gltf" || extension == ".glb") return io::gltf_files(path);
  if (extension == ".inp") return io::inp_files(path);
  if (extension == ".k") return io::dyna_files(path);
  return {path};
}

Paths files_of_volume(const std::filesystem::path& path, std::string_view format) {
  const std::string extension = packed_extension_of(path, format);
  if (extension == ".node" || extension == ".ele" || extension == ".face") return tetgen_files(path);
  const std::filesystem::path plain = io::without_gz(path);
  if (extension == ".vtu" && io::can_have_a_file_beside(path)) return {path, io::surface_beside(plain)};
  if (extension == ".openfoam" || (extension.empty() && io::is_poly_mesh(path)))
    return io::openfoam_files(path);
  if (extension == ".xdmf")
    return {path, io::with_ending(path, ".h5"), io::surface_beside(path),
            io::surface_beside(io::with_ending(path, ".h5"))};
  if (extension == ".pvtu" || extension == ".pvtp") return io::pvtu_files(path);
  if (extension == ".pvd") return io::pvd_files(path);
  if (extension == ".case") return io::ensight_files(path);
  if (extension == ".vtm") {
    const std::filesystem::path grid = io::with_ending(plain, ".vtu");
    return {path, grid, io::surface_beside(grid)};
  }
  return {path};
}

Paths files_of_size_field(const std::filesystem::path& path) {
  const std::string extension = packed_extension_of(path, {});
  Paths files{path};
  const auto add = [&](std::initializer_list<const char*> extensions) {
    for (const char* other : extensions) files.push_back(io::sibling(path, other));
  };
  if (extension == ".mesh" || extension == ".meshb") add({".sol", ".solb"});
  if (extension == ".sol" || extension == ".solb") add({".mesh", ".meshb"});
  if (extension == ".mtr") add({".node", ".ele", ".face", ".edge"});
  return files;
}

}  // namespace holdfast
