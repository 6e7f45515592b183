// Writes triangles in the plane: .off, .node with .ele and .edge, .vtu.
#include <algorithm>
#include <stdexcept>

#include "holdfast/plane.h"
#include "io/atomic_writer.h"
#include "io/text_reader.h"
#include "io/vtu_arrays.h"
#include "numbers/float_environment.h"

namespace holdfast {
namespace io {
namespace {

std::string written_extension(const std::filesystem::path& path, std::string_view format) {
  std::string extension = lower(format.empty() ? path.extension().string() : std::string(format));
  if (!extension.empty() && extension[0] != '.') extension.insert(0, 1, '.');
  return extension;
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
  std::vector<Point> points = mesh.in_space;
  if (points.empty())
    for (const PlanePoint& p : mesh.points) points.push_back({p[0], p[1], 0});
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
  write_vtu_arrays(out, arrays, options);
}

}  // namespace
}  // namespace io

std::vector<std::string> plane_formats() { return {".off", ".node", ".ele", ".vtu"}; }

std::vector<std::filesystem::path> files_of_plane(const std::filesystem::path& path,
                                                  std::string_view format) {
  const std::string extension = io::written_extension(path, format);
  if (extension != ".node" && extension != ".ele") return {path};
  return {std::filesystem::path(path).replace_extension(".node"),
          std::filesystem::path(path).replace_extension(".ele"),
          std::filesystem::path(path).replace_extension(".edge")};
}

void write_plane(const std::filesystem::path& path, const PlaneMesh& mesh, const WriteOptions& options) {
  const FloatEnvironment environment;
  const std::string extension = io::written_extension(path, options.format);
  const std::vector<std::string> known = plane_formats();
  if (std::find(known.begin(), known.end(), extension) == known.end())
    throw FileError(path, "",
                    "the format " + io::in_quotes(extension) +
                        " cannot be written; the formats are .off, .node, .ele, .vtu");
  if (mesh.regions.size() != mesh.triangles.size())
    throw std::invalid_argument("as many region ids as triangles are needed");
  if (mesh.base < 0) throw std::invalid_argument("points are numbered from 0 on");
  io::Watch watch(options, options.progress);
  if (extension == ".node" || extension == ".ele") {
    io::write_triangle(path, mesh, &watch);
  } else {
    io::AtomicWriter out(path, &watch);
    extension == ".off" ? io::write_off(out, mesh) : io::write_grid(out, mesh, options);
    out.commit();
  }
  watch.finish_written();
}

}  // namespace holdfast
