// Writes triangles in the plane: .off, .node with .ele and .edge, and .vtu, which have both regions and
// segments; all other formats as surfaces.
#include <algorithm>
#include <set>
#include <stdexcept>

#include "holdfast/plane.h"
#include "holdfast/surface_io.h"
#include "io/atomic_writer.h"
#include "io/formats.h"
#include "io/labels.h"
#include "io/text_reader.h"
#include "io/vtk_cells.h"
#include "io/vtu_arrays.h"
#include "numbers/float_environment.h"

namespace holdfast {
namespace io {
namespace {

bool is_among(const std::vector<std::string>& formats, const std::string& format) {
  return std::find(formats.begin(), formats.end(), format) != formats.end();
}

bool is_of_triangle(const std::string& format) { return format == ".node" || format == ".ele"; }

/// The formats that the functions below write; surfaces are written in all others.
bool is_own(const std::string& format) {
  return format == ".off" || format == ".vtu" || is_of_triangle(format);
}

/// Names of regions are names of triangles: as names of regions they would be those of tetrahedra later.
Names names_of(const PlaneMesh& mesh) {
  Names names = mesh.names;
  names.facets.merge(names.regions);
  names.regions.clear();
  return names;
}

std::vector<Point> points_of(const PlaneMesh& mesh) {
  std::vector<Point> points = mesh.in_space;
  if (points.empty())
    for (const PlanePoint& p : mesh.points) points.push_back({p[0], p[1], 0});
  return points;
}

void write_off(AtomicWriter& out, const PlaneMesh& mesh) {
  const std::size_t count = mesh.in_space.empty() ? mesh.points.size() : mesh.in_space.size();
  out << "OFF\n" << std::uint64_t{count} << ' ' << std::uint64_t{mesh.triangles.size()} << " 0\n";
  for (const Point& p : mesh.in_space) out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  if (mesh.in_space.empty())
    for (const PlanePoint& p : mesh.points) out << p[0] << ' ' << p[1] << " 0\n";
  for (const Triangle& t : mesh.triangles) out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
}

void write_triangle(const std::filesystem::path& path, const PlaneMesh& mesh, Watch* watch) {
  const auto with = [&](const char* extension) {
    return std::filesystem::path(path).replace_extension(extension);
  };
  AtomicWriter node(with(".node"), watch), ele(with(".ele"), watch), edge(with(".edge"), watch);
  const bool marked = !mesh.point_markers.empty();
  const bool in_space = !mesh.in_space.empty();
  const std::size_t count = in_space ? mesh.in_space.size() : mesh.points.size();
  const auto base = static_cast<std::uint64_t>(mesh.base);
  node << std::uint64_t{count} << (in_space ? " 3" : " 2") << (marked ? " 0 1\n" : " 0 0\n");
  for (std::size_t i = 0; i < count; ++i) {
    const double* const p = in_space ? mesh.in_space[i].data() : mesh.points[i].data();
    node << std::uint64_t{base + i} << ' ' << p[0] << ' ' << p[1];
    if (in_space) node << ' ' << p[2];
    if (marked) node << ' ' << mesh.point_markers[i];
    node << '\n';
  }
  ele << std::uint64_t{mesh.triangles.size()} << " 3 1\n";
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    ele << base + i;
    for (const Index v : t) ele << ' ' << base + v;
    ele << ' ' << mesh.regions[i] << '\n';
  }
  // Only the edges that are segments are listed.
  const bool edges_marked = !mesh.segment_markers.empty();
  edge << std::uint64_t{mesh.segments.size()} << (edges_marked ? " 1\n" : " 0\n");
  for (std::size_t i = 0; i < mesh.segments.size(); ++i) {
    edge << base + i;
    for (const Index v : mesh.segments[i]) edge << ' ' << base + v;
    if (edges_marked) edge << ' ' << mesh.segment_markers[i];
    edge << '\n';
  }
  for (AtomicWriter* file : {&node, &ele, &edge}) file->finish();
  for (AtomicWriter* file : {&node, &ele, &edge}) file->commit();
}

void write_grid(AtomicWriter& out, const PlaneMesh& mesh, const WriteOptions& options) {
  const std::vector<Point> points = points_of(mesh);
  VtuCells cells;
  std::vector<std::int32_t> regions, markers;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    cells.add(VtkCell::triangle, mesh.triangles[i]);
    regions.push_back(mesh.regions[i]);
    // Other formats of triangles have only markers, so that `convert` keeps the regions as these.
    markers.push_back(mesh.regions[i]);
  }
  for (std::size_t i = 0; i < mesh.segments.size(); ++i) {
    cells.add(VtkCell::line, mesh.segments[i]);
    regions.push_back(0);
    markers.push_back(mesh.segment_markers.empty() ? 0 : mesh.segment_markers[i]);
  }
  VtuArrays arrays = cells.arrays(points, {vtu_array("region", regions), vtu_array("marker", markers)});
  if (!mesh.point_markers.empty()) arrays.point_data.push_back(vtu_array("marker", mesh.point_markers));
  arrays.field_data = vtk_fields(names_of(mesh));
  write_vtu_arrays(out, arrays, options);
}

/// What .off does not hold: a single region says nothing.
void tell_not_in_off(const PlaneMesh& mesh, std::vector<Remark>& remarks) {
  const auto tell_markers = [&](const std::vector<int>& markers, const char* one, const char* many) {
    tell_without_place(marked(markers), one, many, ".off", remarks);
  };
  if (std::set<int>(mesh.regions.begin(), mesh.regions.end()).size() > 1)
    tell_markers(mesh.regions, "triangle's region", "triangles' regions");
  tell_markers(mesh.segment_markers, "segment's marker", "segments' markers");
  tell_markers(mesh.point_markers, "point's marker", "points' markers");
}

/// Throws FileError for a format that is not known, and std::invalid_argument for a mesh that is none.
std::string checked_format(const std::filesystem::path& path, const PlaneMesh& mesh,
                           std::string_view format) {
  std::string extension = volume_format_of(path, format);
  const std::vector<std::string> known = plane_formats();
  if (!is_among(known, extension)) {
    std::string list;
    for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
    throw FileError(path, "",
                    "the format " + in_quotes(extension) + " cannot be written; the formats are " + list);
  }
  if (mesh.regions.size() != mesh.triangles.size())
    throw std::invalid_argument("as many region ids as triangles are needed");
  if (mesh.base < 0) throw std::invalid_argument("points are numbered from 0 on");
  return extension;
}

}  // namespace
}  // namespace io

std::vector<std::string> plane_formats() {
  std::vector<std::string> formats{".off", ".node", ".ele", ".vtu"};
  for (const std::vector<std::string>& others : {surface_formats(), volume_formats()})
    for (const std::string& format : others)
      // OpenFOAM's meshes have cells, and TetGen's .face has no points.
      if (!io::is_among(formats, format) && format != ".openfoam" && format != ".face")
        formats.push_back(format);
  return formats;
}

std::vector<std::filesystem::path> files_of_plane(const std::filesystem::path& path,
                                                  std::string_view format) {
  const std::string extension = volume_format_of(path, format);
  if (io::is_of_triangle(extension))
    return {std::filesystem::path(path).replace_extension(".node"),
            std::filesystem::path(path).replace_extension(".ele"),
            std::filesystem::path(path).replace_extension(".edge")};
  return io::is_own(extension) ? std::vector<std::filesystem::path>{path} : files_of_volume(path, format);
}

Surface surface_of(const PlaneMesh& mesh) {
  Surface surface;
  surface.vertices = io::points_of(mesh);
  surface.facets = mesh.triangles;
  surface.facet_markers = mesh.regions;
  surface.segments = mesh.segments;
  surface.segment_markers = mesh.segment_markers;
  surface.vertex_markers = mesh.point_markers;
  surface.names = io::names_of(mesh);
  return surface;
}

void write_plane(const std::filesystem::path& path, const PlaneMesh& mesh, const WriteOptions& options) {
  const FloatEnvironment environment;
  const std::string extension = io::checked_format(path, mesh, options.format);
  if (!io::is_own(extension)) {
    const Surface surface = surface_of(mesh);
    return io::is_among(surface_formats(), extension) ? write_surface(path, surface, options)
                                                      : write_volume(path, io::as_volume(surface), options);
  }
  io::Watch watch(options, options.progress);
  if (io::is_of_triangle(extension)) {
    io::write_triangle(path, mesh, &watch);
  } else {
    io::AtomicWriter out(path, &watch);
    extension == ".off" ? io::write_off(out, mesh) : io::write_grid(out, mesh, options);
    out.commit();
  }
  watch.finish_written();
}

std::vector<Remark> not_held(const std::filesystem::path& path, const PlaneMesh& mesh,
                             const WriteOptions& options) {
  const std::string extension = io::checked_format(path, mesh, options.format);
  if (!io::is_own(extension)) {
    const Surface surface = surface_of(mesh);
    return io::is_among(surface_formats(), extension) ? not_held(path, surface, options)
                                                      : not_held(path, io::as_volume(surface), options);
  }
  std::vector<Remark> remarks;
  if (extension == ".off") io::tell_not_in_off(mesh, remarks);
  if (extension != ".vtu") io::tell_names(io::names_of(mesh), extension, remarks);
  return remarks;
}

}  // namespace holdfast
