// Size fields: a background mesh with a size or a metric at each vertex, in formats of GMF, VTK, TetGen and
// Gmsh.
#include <algorithm>
#include <cmath>
#include <optional>
#include <system_error>

#include "io/file_bytes.h"
#include "io/formats.h"
#include "io/text_reader.h"
#include "metric/metric.h"
#include "numbers/float_environment.h"
#include "size/flat_field.h"
#include "text/count.h"

namespace holdfast::io {
namespace {

bool is_there(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::exists(path, error);
}

// A value is a size, or a metric if it has the six numbers m11 m12 m22 m13 m23 m33.
constexpr std::size_t kTensor = 6;

double read_size(TextReader& text) {
  const double size = text.real("a size");
  if (!(size > 0)) text.fail("the size is not positive");
  return size;
}

void read_value(TextReader& text, std::size_t columns, SizeField& field) {
  if (columns == 1) {
    field.sizes.push_back(read_size(text));
    return;
  }
  Metric m{};
  for (double& x : m) x = text.real("a number of a tensor");
  if (!is_positive_definite(m)) text.fail("the tensor is not positive definite");
  field.metrics.push_back(m);
}

/// A full matrix, row by row; nullopt if it is not symmetric up to rounding in a file.
std::optional<Metric> symmetric(std::span<const double> rows) {
  constexpr double kSlack = 1e-5;
  const double most = kSlack * (std::abs(rows[0]) + std::abs(rows[4]) + std::abs(rows[8]));
  const auto differ = [&](std::size_t i, std::size_t j) { return !(std::abs(rows[i] - rows[j]) <= most); };
  if (differ(1, 3) || differ(2, 6) || differ(5, 7)) return std::nullopt;
  return Metric{rows[0], rows[1], rows[4], rows[2], rows[5], rows[8]};
}

SizeField on_mesh(MeshData mesh, SizeField field) {
  field.vertices = std::move(mesh.vertices);
  field.tetrahedra = std::move(mesh.tetrahedra);
  return field;
}

void require_as_many(const std::filesystem::path& path, std::size_t values, std::size_t vertices) {
  if (values != vertices)
    throw FileError(path, "",
                    "there are sizes for " + counted(values, "vertex", "vertices") + ", but the mesh has " +
                        std::to_string(vertices));
}

/// GMF's .sol: a scalar or a symmetric tensor per vertex of the mesh of the same name.
SizeField read_sol(const Source& source, std::size_t vertices) {
  TextReader text(source);
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
  require_as_many(source.path, count, vertices);
  const std::int64_t solutions = text.integer("the number of solutions");
  const std::int64_t type = text.integer("the type of the solution");
  if (solutions != 1 || (type != 1 && type != 3))
    text.fail("one scalar (type 1) or one symmetric tensor (type 3) a vertex is read");
  SizeField field;
  for (std::size_t k = 0; k < count; ++k) read_value(text, type == 1 ? 1 : kTensor, field);
  return field;
}

/// The binary form of .sol.
SizeField read_solb(const Source& source, std::size_t vertices) {
  GmfSolution solution = read_gmf_solution(source);
  require_as_many(source.path, solution.vertices, vertices);
  SizeField field;
  if (solution.columns == 1)
    field.sizes = std::move(solution.values);
  else
    for (std::size_t k = 0; k < solution.values.size(); k += kTensor)
      std::copy_n(solution.values.begin() + static_cast<std::ptrdiff_t>(k), kTensor,
                  field.metrics.emplace_back().begin());
  return field;
}

/// The file beside `path` with one of two extensions; the first if both exist.
std::filesystem::path beside(const std::filesystem::path& path, const char* ending, const char* other) {
  const std::filesystem::path first = sibling(path, ending), second = sibling(path, other);
  if (is_there(first)) return first;
  if (!is_there(second))
    throw FileError(path, "",
                    "sizes need a mesh and a solution; there is neither " + first.filename().string() +
                        " nor " + second.filename().string() + " beside the file");
  return second;
}

/// Reads a mesh and the values at its vertices from two files; `path` is either of them.
SizeField read_mesh_and_sol(const std::filesystem::path& path, const std::string& extension, Watch& watch) {
  const bool is_mesh = extension == ".mesh" || extension == ".meshb";
  const std::filesystem::path mesh_path = is_mesh ? path : beside(path, ".mesh", ".meshb"),
                              sol_path = is_mesh ? beside(path, ".sol", ".solb") : path;
  const FileBytes mesh_bytes(mesh_path, &watch), sol_bytes(sol_path, &watch);
  MeshData mesh = parse_volume({mesh_path, mesh_bytes.view(), true, &watch});
  const auto read = lower(without_gz(sol_path).extension().string()) == ".solb" ? read_solb : read_sol;
  SizeField field = read({sol_path, sol_bytes.view(), true, &watch}, mesh.vertices.size());
  return on_mesh(std::move(mesh), std::move(field));
}

/// TetGen's .mtr: a line "count columns", then a size or a symmetric tensor per vertex.
SizeField read_mtr(const Source& source) {
  TextReader text(source);
  const std::size_t count = text.count("the number of vertices", 2);
  const std::int64_t columns = text.integer("the number of columns");
  if (columns != 1 && columns != kTensor) text.fail("1 column (sizes) or 6 (metric tensors) are read");
  SizeField field;
  for (std::size_t k = 0; k < count; ++k) read_value(text, static_cast<std::size_t>(columns), field);
  if (!text.at_end())
    text.fail_at(text.position(), "more follows than the " + counted(count, "size") + " announced");
  return field;
}

Metric read_full_tensor(TextReader& text) {
  std::array<double, 9> rows{};
  for (double& x : rows) x = text.real("a number of a tensor");
  const std::optional<Metric> m = symmetric(rows);
  if (!m || !is_positive_definite(*m)) text.fail("the tensor is not symmetric and positive definite");
  return *m;
}

/// Gmsh's .pos (parsed form): scalars or tensors on tetrahedra, SS(x,y,z,...){s,s,s,s}; or TT(...){...};
SizeField read_pos(const Source& source) {
  std::string plain(source.bytes);
  for (char& c : plain)
    if (c == ',' || c == '(' || c == ')' || c == '{' || c == '}' || c == ';') c = ' ';
  TextReader text({source.path, plain, source.finite}, '\0');
  SizeField field;
  while (!text.at_end()) {
    const std::string word = lower(text.word("SS"));
    if (word == "view") {
      if (!text.at_line_end()) static_cast<void>(text.rest_of_line());
      continue;
    }
    if (word != "ss" && word != "tt") text.fail("expected a tetrahedron SS or TT, found " + in_quotes(word));
    if (word == "ss" ? !field.metrics.empty() : !field.sizes.empty())
      text.fail("scalars (SS) and tensors (TT) are not read together");
    Tetrahedron corners{};
    for (Index& corner : corners) {
      corner = static_cast<Index>(field.vertices.size());
      field.vertices.push_back(text.point());
    }
    for (int i = 0; i < 4; ++i)
      if (word == "ss")
        field.sizes.push_back(read_size(text));
      else
        field.metrics.push_back(read_full_tensor(text));
    field.tetrahedra.push_back(corners);
  }
  return field;
}

/// Reads one array of points: scalars, VTK's symmetric tensors (xx yy zz xy yz xz), or full ones.
SizeField field_of(const PointArray& array, const std::filesystem::path& path) {
  SizeField field;
  if (array.components == 1) {
    field.sizes = array.values;
    return field;
  }
  if (array.components != kTensor && array.components != 9)
    throw FileError(
        path, "", "metric tensors of 6 or 9 components are read, not of " + std::to_string(array.components));
  for (std::size_t k = 0; k < array.values.size(); k += array.components) {
    const std::span<const double> x = std::span(array.values).subspan(k, array.components);
    const std::optional<Metric> m =
        array.components == 9 ? symmetric(x) : Metric{x[0], x[3], x[1], x[5], x[4], x[2]};
    if (!m)
      throw FileError(path, "vertex " + std::to_string(k / array.components), "the tensor is not symmetric");
    field.metrics.push_back(*m);
  }
  return field;
}

SizeField read_by_extension(const std::filesystem::path& path, Watch& watch) {
  const std::string extension = lower(without_gz(path).extension().string());
  for (const char* ending : {".mesh", ".meshb", ".sol", ".solb"})
    if (extension == ending) return read_mesh_and_sol(path, extension, watch);
  const FileBytes bytes(path, &watch);
  const Source source{path, bytes.view(), true, &watch};
  if (extension == ".mtr") {
    SizeField field = read_mtr(source);
    const std::filesystem::path nodes = sibling(path, ".node");
    if (is_there(sibling(path, ".ele")))
      return on_mesh(read_tetgen_volume({nodes, {}, true, &watch}), std::move(field));
    if (!field.metrics.empty())
      throw FileError(path, "", "metric tensors need a background mesh, its .node and .ele beside the .mtr");
    return field;
  }
  if (extension == ".pos") return read_pos(source);
  if (extension == ".vtu") {
    constexpr const char* kNames[] = {"size", "metric"};
    PointArray array;
    MeshData mesh = read_vtu(source, kNames, array);
    return on_mesh(std::move(mesh), field_of(array, path));
  }
  throw FileError(path, "",
                  "the format " + in_quotes(extension) +
                      " cannot be read as a size field; the formats are .mesh or .meshb with .sol or "
                      ".solb beside it, .vtu (with a point array \"size\" or \"metric\"), .mtr, .pos");
}

}  // namespace
}  // namespace holdfast::io

namespace holdfast {

SizeField read_size_field(const std::filesystem::path& path, const ReadOptions& options) {
  const FloatEnvironment environment;
  io::Watch watch(options, options.progress);
  SizeField field = io::read_by_extension(path, watch);
  const std::size_t count = field.sizes.size() + field.metrics.size();
  if (!field.vertices.empty() && count != field.vertices.size())
    throw FileError(path, "",
                    "there are " + std::to_string(count) + " sizes for " +
                        std::to_string(field.vertices.size()) + " vertices");
  for (std::size_t v = 0; v < field.vertices.size(); ++v)
    for (const double x : field.vertices[v])
      if (!std::isfinite(x))
        throw FileError(path, "vertex " + std::to_string(v), "a coordinate is not finite");
  if (count == 0) throw FileError(path, "", "there is no size in it");
  if (!field.vertices.empty() && field.tetrahedra.empty())
    throw FileError(path, "", "the background mesh has no tetrahedra");
  if (is_flat(field))
    throw FileError(path, "",
                    "every tetrahedron of the background mesh is flat, so it has no sizes anywhere");
  for (std::size_t v = 0; v < field.sizes.size(); ++v)
    if (!(field.sizes[v] > 0 && std::isfinite(field.sizes[v])))
      throw FileError(path, "vertex " + std::to_string(v), "the size is not a positive number");
  for (std::size_t v = 0; v < field.metrics.size(); ++v)
    if (!is_positive_definite(field.metrics[v]))
      throw FileError(path, "vertex " + std::to_string(v), "the tensor is not positive definite");
  watch.finish();
  return field;
}

}  // namespace holdfast
