// Polygons in space as points and segments in planes.
#include <cmath>

#include "holdfast/plane.h"
#include "io/file_bytes.h"
#include "io/formats.h"
#include "io/plane_files.h"
#include "io/polygon.h"
#include "io/text_reader.h"
#include "numbers/float_environment.h"
#include "text/decimal.h"

namespace holdfast {
namespace io {
namespace {

/// The contents of a file as facets; without any, all its points form one.
std::vector<plane::PolygonFacet> facets_of(MeshData& mesh) {
  std::vector<plane::PolygonFacet> facets = std::move(mesh.polygons);
  for (const Triangle& t : mesh.facets) facets.push_back({{{t.begin(), t.end()}}, {}});
  for (const Segment& s : mesh.segments) facets.push_back({{{s.begin(), s.end()}}, {}});
  if (facets.empty()) {
    facets.emplace_back();
    for (Index v = 0; v < mesh.vertices.size(); ++v) facets[0].polygons.push_back({v});
  }
  return facets;
}

PlanesInSpace planes_of(const Source& source, MeshData&& mesh) {
  const std::size_t segments = mesh.segments.size();
  const std::vector<plane::PolygonFacet> facets = facets_of(mesh);
  plane::FoundPlanes found = plane::planes_of(mesh.vertices, facets, source.tolerance, poll_of(source.watch));
  if (!found.reason.empty()) {
    const std::size_t polygons = facets.size() - segments;
    std::string where;  // the file as a whole, where it has no polygons
    if (found.facet < polygons)
      where = "polygon " + std::to_string(found.facet + 1);
    else if (polygons > 0)
      where = "segment " + std::to_string(found.facet - polygons + 1);
    throw FileError(source.path, where, found.reason);
  }
  PlanesInSpace planes = std::move(found.planes);
  const std::vector<int> of_vertices = mesh.vertex_markers.take(mesh.vertices.size()),
                         of_segments = mesh.segment_markers.take(segments);
  for (PlanesInSpace::Part& part : planes.parts)
    plane::mark(part, mesh.vertices, of_vertices, mesh.segments, of_segments);
  planes.points = std::move(mesh.vertices);
  planes.remarks = std::move(mesh.remarks);
  planes.names.segments = std::move(mesh.names.segments);
  planes.names.vertices = std::move(mesh.names.vertices);
  if (found.deviation > 0)
    planes.remarks.push_back({RemarkKind::polygons_cut, 1,
                              "corners lie up to " + decimal(found.deviation, 3) +
                                  " from the mean plane in which they are taken"});
  return planes;
}

/// Whether a .poly or .node begins with "n 3" and is therefore three-dimensional.
bool has_three_dimensions(const Source& source) {
  TextReader text(source);
  static_cast<void>(text.count("the number of points", 6));
  return !text.at_line_end() && text.integer("the dimension") == 3;
}

}  // namespace
}  // namespace io

PlanesInSpace read_planes(const std::filesystem::path& path, const ReadOptions& options) {
  const FloatEnvironment environment;
  if (!(options.tolerance >= 0) || std::isinf(options.tolerance))
    throw std::invalid_argument("the tolerance for polygons must be finite and not negative");
  constexpr double kLeastStep = 0.1, kMostStep = 120;  // so an arc has few points, and a circle three
  if (options.arc_step != 0 && !(options.arc_step >= kLeastStep && options.arc_step <= kMostStep))
    throw std::invalid_argument("arcs are divided into pieces of 0.1 to 120 degrees");
  io::Watch watch(options, options.progress);
  const io::FileBytes bytes(path, &watch);
  io::Source source{path, bytes.view(), false, &watch, options.tolerance, true, options.arc_step};
  const std::string extension = io::plane_extension_of(path, options.format);
  PlanesInSpace planes;
  if ((extension == ".poly" || extension == ".node") && !io::has_three_dimensions(source)) {
    planes.parts.resize(1);
    planes.parts[0].plane = io::parse_plane(source, extension);
    planes.remarks = std::move(planes.parts[0].plane.remarks);
  } else {
    planes = io::planes_of(source, io::parse_surface(source, options.format));
  }
  watch.finish();
  return planes;
}

}  // namespace holdfast
