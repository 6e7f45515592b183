// The public functions of holdfast/io.h: formats by extension, and the requirements on a file.
#include "holdfast/io.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "io/ac3d_read.h"
#include "io/brain_surfaces.h"
#include "io/cells.h"
#include "io/endings.h"
#include "io/file_bytes.h"
#include "io/formats.h"
#include "io/indices.h"
#include "io/labels.h"
#include "io/mid_nodes.h"
#include "io/text_reader.h"
#include "io/threeds_read.h"
#include "io/vrml_read.h"
#include "numbers/float_environment.h"
#include "text/count.h"
#include "text/decimal.h"

namespace holdfast {
namespace io {
namespace {

using Reader = MeshData (*)(const Source&);
using Writer = void (*)(const std::filesystem::path&, const Volume&, const WriteOptions&, Watch&);

/// Writes one file, which gets its name when it is complete.
template <auto write>
void write_file(const std::filesystem::path& path, const Volume& volume, const WriteOptions& options,
                Watch& watch) {
  AtomicWriter out(path, &watch);
  if constexpr (std::is_invocable_v<decltype(write), AtomicWriter&, const Volume&, const WriteOptions&>)
    write(out, volume, options);
  else
    write(out, volume);
  out.commit();
}

void write_tetgen_files(const std::filesystem::path& path, const Volume& volume, const WriteOptions&,
                        Watch& watch) {
  write_tetgen(path, volume, &watch);
}

using Remarks = std::vector<Remark> (*)(const Volume&, const WriteOptions&);

constexpr double kRead = 0.3;  // share of the work once the bytes of a file are in memory

struct Format {
  std::string_view extension;
  Reader surface, volume;      ///< null: not readable as this
  Writer write;                ///< null: cannot be written as a volume
  Remarks not_held = nullptr;  ///< what the writer does not store unchanged; null: it stores everything
  bool has_names = true;       ///< names of ids are written
};

constexpr Format kFormats[] = {
    {".off", read_off, nullptr, nullptr},
    {".stl", read_stl, nullptr, nullptr},
    {".obj", read_obj, nullptr, nullptr},
    {".ply", read_ply, nullptr, nullptr},
    {".3mf", read_3mf, nullptr, nullptr},
    {".amf", read_amf, nullptr, nullptr},
    {".gltf", read_gltf, nullptr, nullptr},
    {".glb", read_gltf, nullptr, nullptr},
    {".wrl", read_vrml, nullptr, nullptr},
    {".wrz", read_vrml, nullptr, nullptr},
    {".x3d", read_vrml, nullptr, nullptr},
    {".ts", read_gocad, nullptr, nullptr},
    {".gts", read_gts, nullptr, nullptr},
    {".ac", read_ac3d, nullptr, nullptr},
    {".3ds", read_3ds, nullptr, nullptr},
    {".gii", read_gifti, nullptr, nullptr},
    {".freesurfer", read_freesurfer, nullptr, nullptr},
    {".dae", read_dae, nullptr, nullptr},
    {".dxf", read_dxf, nullptr, nullptr},
    {".mesh", read_medit, read_medit, write_file<write_medit>, nullptr, false},
    {".meshb", read_gmf, read_gmf, write_file<write_gmf>, nullptr, false},
    {".poly", read_poly, nullptr, nullptr},
    {".smesh", read_smesh, nullptr, nullptr},
    {".vtu", read_vtu, read_vtu, write_vtu},
    {".pvtu", read_pvtu, read_pvtu, nullptr},
    {".pvtp", read_pvtu, nullptr, nullptr},
    {".pvd", read_pvd, read_pvd, nullptr},
    {".vtm", read_vtm, read_vtm, write_vtm},
    {".vtp", read_vtu, nullptr, nullptr},
    {".vtk", read_vtk, read_vtk, write_file<write_vtk>},
    {".msh", read_msh_surface, read_msh, write_file<write_msh>, not_in_msh},
    {".inp", read_inp, read_inp, write_file<write_inp>, not_in_inp},
    {".avs", read_avs, read_avs, nullptr},
    {".ucd", read_avs, read_avs, nullptr},
    {".unv", read_unv, read_unv, write_file<write_unv>, not_in_unv},
    {".bdf", read_bdf, read_bdf, write_file<write_bdf>, not_in_bdf},
    {".nas", read_bdf, read_bdf, write_file<write_bdf>, not_in_bdf},
    {".fem", read_bdf, read_bdf, nullptr},
    {".su2", read_su2, read_su2, write_file<write_su2>, not_in_su2},
    {".mfem", read_mfem, read_mfem, write_file<write_mfem>, not_in_mfem},
    {".vol", read_vol, read_vol, write_file<write_vol>, not_in_vol},
    {".xdmf", read_xdmf, read_xdmf, write_xdmf, not_in_xdmf},
    {".med", read_med, read_med, write_file<write_med>, not_in_med},
    {".exo", read_exodus, read_exodus, write_file<write_exodus>, not_in_exodus},
    {".cgns", read_cgns, read_cgns, write_file<write_cgns>, not_in_cgns},
    {".fluent", read_fluent_surface, read_fluent, write_fluent, not_in_fluent},
    {".case", read_ensight, read_ensight, nullptr},
    {".cas", read_fluent_surface, read_fluent, nullptr},
    {".k", read_dyna, read_dyna, write_file<write_dyna>, not_in_dyna},
    {".cdb", read_cdb, read_cdb, write_file<write_cdb>, not_in_cdb},
    {".feb", read_febio, read_febio, write_file<write_febio>, not_in_febio},
    {".xml", read_dolfin, read_dolfin, write_file<write_dolfin>, not_in_dolfin},
    {".openfoam", read_openfoam, read_openfoam, write_openfoam, not_in_openfoam},
    {".node", read_node, read_tetgen_volume, write_tetgen_files, nullptr, false},
    {".ele", nullptr, read_tetgen_volume, write_tetgen_files, nullptr, false},
    {".face", nullptr, read_tetgen_volume, write_tetgen_files, nullptr, false},
};

/// The bytes of a file; none for a format that is a folder.
std::optional<FileBytes> bytes_of(const std::filesystem::path& path, const Format& format, Watch& watch) {
  std::optional<FileBytes> bytes;
  if (format.extension != ".openfoam") bytes.emplace(path, &watch);
  watch.step(kRead);
  return bytes;
}
std::string_view view_of(const std::optional<FileBytes>& bytes) {
  return bytes ? bytes->view() : std::string_view();
}

void tell_behind(const std::optional<FileBytes>& bytes, MeshData& mesh) {
  if (bytes)
    mesh.leave_out(bytes->behind(), "bytes after the compressed data", "byte after the compressed data");
}

/// The format's name as in the table: lower case, with a dot.
std::string extension_of(const std::filesystem::path& path, std::string_view format) {
  std::string extension = lower(format.empty() ? path.extension().string() : std::string(format));
  if (!extension.empty() && extension[0] != '.') extension.insert(0, 1, '.');
  if (extension.empty() && is_poly_mesh(path)) extension = ".openfoam";
  return usual_ending(std::move(extension));
}

/// How to convert a file of an unsupported format into a readable one; empty if unknown.
std::string_view way_out_of(std::string_view extension) {
  struct Way {
    std::string_view extension, text;
  };
  static constexpr std::string_view kOfCad =
      "; it describes shapes, without triangles: export it as STL, or `gmsh -2 IN -o OUT.stl` makes some";
  static constexpr std::string_view kOfScenes = "; Blender, MeshLab or assimp save it as .obj";
  static constexpr std::string_view kOfParaView = "; ParaView saves it as .vtu",
                                    kOfMeshio = "; `meshio convert IN OUT.vtu` reads it",
                                    kOfFoam = "; give the case's folder",
                                    kOfAscii = "; if it is STL, give the format .stl";
  static constexpr Way kWays[] = {{".step", kOfCad},
                                  {".stp", kOfCad},
                                  {".iges", kOfCad},
                                  {".igs", kOfCad},
                                  {".brep", kOfCad},
                                  {".geo", kOfCad},
                                  {".fbx", kOfScenes},
                                  {".blend", kOfScenes},
                                  {".lwo", kOfScenes},
                                  {".x", kOfScenes},
                                  {".ctm", kOfScenes},
                                  {".vtkhdf", kOfParaView},
                                  {".ugrid", kOfMeshio},
                                  {".mdpa", kOfMeshio},
                                  {".f3grid", kOfMeshio},
                                  {".tec", kOfMeshio},
                                  {".foam", kOfFoam},
                                  {".ast", kOfAscii},
                                  {".scad", "; `openscad -o OUT.off IN` makes a surface of it"}};
  for (const Way& way : kWays)
    if (way.extension == extension) return way.text;
  return {};
}

/// What a file without a format is called in messages.
std::string without_format(const std::filesystem::path& path, bool reads) {
  std::error_code error;
  if (!reads || !std::filesystem::is_directory(path, error)) return "a name without extension";
  if (is_poly_mesh(path / "processor0"))
    return "a case that is only decomposed (`reconstructParMesh -constant` makes its mesh, and each of "
           "processor0, ... can be read)";
  if (is_poly_mesh(path / "polyMesh"))
    return "a folder around a polyMesh (give " + (path / "polyMesh").string() + " itself)";
  return "a folder without constant/polyMesh";
}

/// The entry of an extension for which `suits` is true; otherwise throws and lists those that would do.
template <typename Suits>
const Format& find_format(const std::filesystem::path& path, std::string_view extension, std::string_view use,
                          Suits&& suits) {
  const bool reads = use.starts_with("read");
  std::string known;
  for (const Format& format : kFormats) {
    if (!suits(format)) continue;
    if (format.extension == extension) return format;
    known += (known.empty() ? "" : ", ") + std::string(format.extension);
  }
  const std::string name =
      extension.empty() ? without_format(path, reads) : "the format " + in_quotes(extension);
  throw FileError(path, "",
                  name + " cannot be " + std::string(use) +
                      (reads ? std::string(way_out_of(extension)) : "") + "; the formats are " + known);
}

const Format& surface_format(const std::filesystem::path& path, std::string_view format) {
  return find_format(path, extension_of(without_gz(path), format), "read as a surface",
                     [](const Format& f) { return f.surface != nullptr; });
}

const Format& volume_format(const std::filesystem::path& path, std::string_view format) {
  return find_format(path, extension_of(without_gz(path), format), "read as a volume",
                     [](const Format& f) { return f.volume != nullptr; });
}

const Format& writer_of(const std::filesystem::path& path, std::string_view format) {
  return find_format(path, extension_of(path, format), "written",
                     [](const Format& f) { return f.write != nullptr; });
}

/// A volume whose tags do not match its entities is an error of the caller.
void require_consistent(const Volume& volume) {
  const auto matches = [](const auto& tags, std::size_t count) {
    return tags.empty() || tags.size() == count;
  };
  if (!matches(volume.vertex_markers, volume.vertices.size()) ||
      !matches(volume.regions, volume.tetrahedra.size()) ||
      !matches(volume.facet_markers, volume.facets.size()) ||
      !matches(volume.segment_markers, volume.segments.size()) ||
      !matches(volume.input_vertices, volume.vertices.size()))
    throw std::invalid_argument(
        "a volume with regions, markers or input vertices of another number than their entities");
  require_indices(volume);
}

void tell_polygons(MeshData& mesh) {
  const PolygonCounts& counts = mesh.polygon_counts;
  mesh.leave_out(counts.left_out, "faces of fewer than three corners", "face of fewer than three corners");
  if (counts.cut == 0) return;
  std::string message = counted(counts.cut, "polygon") + " of more than three corners " +
                        (counts.cut == 1 ? "is" : "are") + " cut into triangles";
  if (counts.deviation > 0)
    message +=
        "; their corners lie up to " + decimal(counts.deviation, 3) + " from the mean plane of their polygon";
  if (counts.crossing > 0)
    message += "; the sides of " + std::to_string(counts.crossing) +
               " cross or overlap, and triangles of such a polygon may cross, too";
  mesh.remarks.push_back({RemarkKind::polygons_cut, counts.cut, std::move(message)});
}

void tell_cells(MeshData& mesh, RemarkKind kind, const char* what) {
  const std::size_t count = mesh.cells.hexahedra + mesh.cells.prisms + mesh.cells.pyramids;
  if (count > 0)
    mesh.remarks.push_back({kind, count, words_of(mesh.cells) + (count == 1 ? " is " : " are ") + what});
}

/// What was left out explains why nothing is there.
[[noreturn]] void refuse_empty(const Source& source, const MeshData& mesh) {
  std::string message = "the file holds no vertices";
  for (const Remark& remark : mesh.remarks)
    if (remark.kind == RemarkKind::left_out) message += "; " + remark.message;
  throw FileError(source.path, "", message);
}

double tolerance_of(const ReadOptions& options) {
  if (!(options.tolerance >= 0) || std::isinf(options.tolerance))
    throw std::invalid_argument("the tolerance for polygons must be finite and not negative");
  return options.tolerance;
}

}  // namespace

MeshData parse_surface(const Source& source, std::string_view format) {
  MeshData mesh = surface_format(source.path, format).surface(source);
  if (mesh.vertices.empty()) refuse_empty(source, mesh);
  settle_quadrangles(mesh);
  settle_mid_nodes(mesh, false);
  tell_polygons(mesh);
  mesh.leave_out(mesh.tetrahedra.size() - mesh.cells.tetrahedra, "tetrahedra", "tetrahedron");
  tell_cells(mesh, RemarkKind::left_out, "left out");
  return mesh;
}

MeshData parse_volume(const Source& source, std::string_view format) {
  MeshData mesh = volume_format(source.path, format).volume(source);
  settle_quadrangles(mesh);
  settle_mid_nodes(mesh, true);
  tell_polygons(mesh);
  tell_cells(mesh, RemarkKind::cells_split, "split into tetrahedra");
  return mesh;
}

}  // namespace io

Surface read_surface(const std::filesystem::path& path, const ReadOptions& options) {
  const FloatEnvironment environment;
  const io::Format& format = io::surface_format(path, options.format);
  io::Watch watch(options, options.progress);
  const auto bytes = io::bytes_of(path, format, watch);
  io::MeshData mesh =
      io::parse_surface({path, io::view_of(bytes), false, &watch, io::tolerance_of(options)}, options.format);
  io::tell_behind(bytes, mesh);
  Surface surface;
  surface.vertex_markers = mesh.vertex_markers.take(mesh.vertices.size());
  surface.facet_markers = mesh.facet_markers.take(mesh.facets.size());
  surface.segment_markers = mesh.segment_markers.take(mesh.segments.size());
  surface.vertices = std::move(mesh.vertices);
  surface.facets = std::move(mesh.facets);
  surface.segments = std::move(mesh.segments);
  surface.regions = std::move(mesh.region_seeds);
  surface.holes = std::move(mesh.holes);
  surface.remarks = std::move(mesh.remarks);
  surface.names = std::move(mesh.names);
  if (!mesh.tetrahedra.empty()) surface.names.regions.clear();  // of tetrahedra, which are dropped
  watch.finish();
  return surface;
}

Volume read_volume(const std::filesystem::path& path, const ReadOptions& options,
                   std::vector<Remark>* remarks) {
  const FloatEnvironment environment;
  const io::Format& format = io::volume_format(path, options.format);
  io::Watch watch(options, options.progress);
  const auto bytes = io::bytes_of(path, format, watch);
  io::MeshData mesh =
      io::parse_volume({path, io::view_of(bytes), false, &watch, io::tolerance_of(options)}, options.format);
  io::tell_behind(bytes, mesh);
  Volume volume;
  volume.regions = mesh.regions.take(mesh.tetrahedra.size());
  volume.regions.resize(mesh.tetrahedra.size(), 0);
  volume.vertex_markers = mesh.vertex_markers.take(mesh.vertices.size());
  volume.facet_markers = mesh.facet_markers.take(mesh.facets.size());
  volume.segment_markers = mesh.segment_markers.take(mesh.segments.size());
  volume.vertices = std::move(mesh.vertices);
  volume.tetrahedra = std::move(mesh.tetrahedra);
  volume.facets = std::move(mesh.facets);
  volume.segments = std::move(mesh.segments);
  volume.names = std::move(mesh.names);
  volume.mid_nodes = std::move(mesh.mid_nodes);
  if (remarks != nullptr) *remarks = std::move(mesh.remarks);
  watch.finish();
  return volume;
}

std::vector<Point> read_points(const std::filesystem::path& path, const ReadOptions& options) {
  if (io::extension_of(path, options.format) != ".xyz") return read_surface(path, options).vertices;
  const FloatEnvironment environment;
  io::Watch watch(options, options.progress);
  const io::FileBytes bytes(path, &watch);
  watch.step(io::kRead);
  std::vector<Point> points = io::read_xyz({path, bytes.view(), false, &watch}).vertices;
  watch.finish();
  return points;
}

Surface read_surface(const std::filesystem::path& path, std::string_view format) {
  ReadOptions options;
  options.format = format;
  return read_surface(path, options);
}

Volume read_volume(const std::filesystem::path& path, std::string_view format) {
  ReadOptions options;
  options.format = format;
  return read_volume(path, options);
}

std::vector<Point> read_points(const std::filesystem::path& path, std::string_view format) {
  ReadOptions options;
  options.format = format;
  return read_points(path, options);
}

std::vector<std::string> readable_volume_formats() {
  std::vector<std::string> extensions;
  for (const io::Format& format : io::kFormats)
    if (format.volume != nullptr) extensions.emplace_back(format.extension);
  return extensions;
}

std::string volume_format_of(const std::filesystem::path& path, std::string_view format) {
  return io::extension_of(path, format);
}

std::vector<std::string> volume_formats() {
  std::vector<std::string> extensions;
  for (const io::Format& format : io::kFormats)
    if (format.write != nullptr) extensions.emplace_back(format.extension);
  return extensions;
}

std::vector<Remark> not_held(const std::filesystem::path& path, const Volume& volume,
                             const WriteOptions& options) {
  const io::Format& writer = io::writer_of(path, options.format);
  std::vector<Remark> remarks;
  if (writer.not_held != nullptr) remarks = writer.not_held(volume, options);
  if (!writer.has_names) io::tell_names(volume.names, writer.extension, remarks);
  return remarks;
}

void write_volume(const std::filesystem::path& path, const Volume& volume, const WriteOptions& options) {
  const FloatEnvironment environment;
  const io::Format& writer = io::writer_of(path, options.format);
  io::require_consistent(volume);
  io::Watch watch(options, options.progress);
  writer.write(path, volume, options, watch);
  watch.finish_written();
}

void write_bytes(const std::filesystem::path& path, std::string_view bytes) {
  io::AtomicWriter out(path);
  out << bytes;
  out.commit();
}

}  // namespace holdfast
