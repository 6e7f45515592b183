// Size fields: a background mesh with a size at each vertex, in the files of GMF, VTK, TetGen and Gmsh.
#include <cmath>
#include <system_error>

#include "io/file_bytes.h"
#include "io/formats.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

std::filesystem::path with_extension(std::filesystem::path path, const char* extension) {
  return path.replace_extension(extension);
}

bool is_there(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::exists(path, error);
}

/// GMF's .sol: one scalar a vertex of the mesh of the same name.
std::vector<double> read_sol(const std::filesystem::path& path, std::size_t vertices) {
  const FileBytes bytes(path);
  TextReader text({path, bytes.view()});
  for (;;) {
    const std::string word = lower(text.word("SolAtVertices"));
    if (word == "end") text.fail("there is no section SolAtVertices");
    if (word == "dimension") {
      if (text.integer("the dimension") != 3) text.fail("the dimension is not 3");
    } else if (word == "meshversionformatted") {
      static_cast<void>(text.integer("the version"));
    } else if (word == "solatvertices") {
      break;
    } else {
      text.fail("expected SolAtVertices, found " + in_quotes(word));
    }
  }
  const std::size_t count = text.count("the number of vertices", 2);
  if (count != vertices)
    text.fail("there are sizes for " + std::to_string(count) + " vertices, but the mesh has " +
              std::to_string(vertices));
  if (text.integer("the number of solutions") != 1 || text.integer("the type of the solution") != 1)
    text.fail("one scalar a vertex is read; metric tensors are not");
  std::vector<double> sizes(count);
  for (double& size : sizes) size = text.real("a size");
  return sizes;
}

/// TetGen's .mtr: a line "count columns", then a size a vertex.
std::vector<double> read_mtr(const Source& source) {
  TextReader text(source);
  const std::size_t count = text.count("the number of vertices", 2);
  if (text.integer("the number of columns") != 1)
    text.fail("one size a vertex is read; metric tensors are not");
  std::vector<double> sizes(count);
  for (double& size : sizes) size = text.real("a size");
  return sizes;
}

/// Gmsh's .pos (parsed form): scalars on tetrahedra, SS(x,y,z,...){s,s,s,s};
SizeField read_pos(const Source& source) {
  std::string plain(source.bytes);
  for (char& c : plain)
    if (c == ',' || c == '(' || c == ')' || c == '{' || c == '}' || c == ';') c = ' ';
  TextReader text({source.path, plain}, '\0');
  SizeField field;
  while (!text.at_end()) {
    const std::string word = lower(text.word("SS"));
    if (word == "view") {
      if (!text.at_line_end()) static_cast<void>(text.rest_of_line());
      continue;
    }
    if (word != "ss") text.fail("expected a scalar tetrahedron SS, found " + in_quotes(word));
    Tetrahedron corners{};
    for (Index& corner : corners) {
      corner = static_cast<Index>(field.vertices.size());
      field.vertices.push_back(text.point());
    }
    for (int i = 0; i < 4; ++i) field.sizes.push_back(text.real("a size"));
    field.tetrahedra.push_back(corners);
  }
  return field;
}

SizeField with_sizes(MeshData mesh, std::vector<double> sizes) {
  SizeField field;
  field.vertices = std::move(mesh.vertices);
  field.tetrahedra = std::move(mesh.tetrahedra);
  field.sizes = std::move(sizes);
  return field;
}

SizeField read_by_extension(const std::filesystem::path& path) {
  const std::string extension = lower(path.extension().string());
  const FileBytes bytes(path);
  const Source source{path, bytes.view()};
  if (extension == ".mtr") {
    SizeField field;
    field.sizes = read_mtr(source);
    if (!is_there(with_extension(path, ".ele"))) return field;
    MeshData mesh = read_tetgen_volume({with_extension(path, ".node"), {}});
    return with_sizes(std::move(mesh), std::move(field.sizes));
  }
  if (extension == ".pos") return read_pos(source);
  if (extension == ".vtu") {
    std::vector<double> sizes;
    MeshData mesh = read_vtu(source, &sizes);
    return with_sizes(std::move(mesh), std::move(sizes));
  }
  if (extension == ".sol" || extension == ".mesh" || extension == ".meshb") {
    std::filesystem::path mesh_path = path;
    if (extension == ".sol")
      mesh_path = with_extension(path, is_there(with_extension(path, ".mesh")) ? ".mesh" : ".meshb");
    const FileBytes mesh_bytes(mesh_path);
    MeshData mesh = parse_volume({mesh_path, mesh_bytes.view()});
    std::vector<double> sizes = read_sol(with_extension(path, ".sol"), mesh.vertices.size());
    return with_sizes(std::move(mesh), std::move(sizes));
  }
  throw FileError(path, "",
                  "the format " + in_quotes(extension) +
                      " cannot be read as a size field; the formats are .mesh, .meshb and .sol (a mesh and "
                      "its .sol), .vtu (with a point array \"size\"), .mtr, .pos");
}

}  // namespace
}  // namespace holdfast::io

namespace holdfast {

SizeField read_size_field(const std::filesystem::path& path) {
  SizeField field = io::read_by_extension(path);
  if (!field.vertices.empty() && field.sizes.size() != field.vertices.size())
    throw FileError(path, "",
                    "there are " + std::to_string(field.sizes.size()) + " sizes for " +
                        std::to_string(field.vertices.size()) + " vertices");
  if (!field.vertices.empty() && field.tetrahedra.empty())
    throw FileError(path, "", "the background mesh has no tetrahedra");
  for (std::size_t v = 0; v < field.sizes.size(); ++v)
    if (!(field.sizes[v] > 0 && std::isfinite(field.sizes[v])))
      throw FileError(path, "vertex " + std::to_string(v), "the size is not a positive number");
  return field;
}

}  // namespace holdfast
