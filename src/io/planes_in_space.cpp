// Polygons in space as points and segments in planes.
#include <algorithm>
#include <cmath>
#include <map>

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

Segment ordered(const Segment& s) { return {std::min(s[0], s[1]), std::max(s[0], s[1])}; }

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

bool has_markers(const MeshData& mesh) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (mesh.vertex_markers.of(v) != 0) return true;
  for (std::size_t s = 0; s < mesh.segments.size(); ++s)
    if (mesh.segment_markers.of(s) != 0) return true;
  return false;
}

/// Puts the markers of vertices and segments on those of a plane. Of several at one place, the first counts.
void mark(PlanesInSpace::Part& part, const MeshData& mesh) {
  std::map<Point, Index> at;
  for (Index v = 0; v < part.numbers.size(); ++v) at.try_emplace(mesh.vertices[part.numbers[v]], v);
  const auto place_of = [&](Index vertex) {
    const auto found = at.find(mesh.vertices[vertex]);
    return found == at.end() ? no_entity : found->second;
  };
  Plane& plane = part.plane;
  for (Index v = 0; v < mesh.vertices.size(); ++v) {
    const Index place = mesh.vertex_markers.of(v) == 0 ? no_entity : place_of(v);
    if (place == no_entity) continue;
    plane.point_markers.resize(plane.points.size(), 0);
    if (plane.point_markers[place] == 0) plane.point_markers[place] = mesh.vertex_markers.of(v);
  }
  std::map<Segment, std::size_t> number;
  for (std::size_t s = 0; s < plane.segments.size(); ++s) number[ordered(plane.segments[s])] = s;
  for (std::size_t i = 0; i < mesh.segments.size(); ++i) {
    if (mesh.segment_markers.of(i) == 0) continue;
    const auto found = number.find(ordered({place_of(mesh.segments[i][0]), place_of(mesh.segments[i][1])}));
    if (found == number.end()) continue;
    plane.segment_markers.resize(plane.segments.size(), 0);
    int& marker = plane.segment_markers[found->second];
    if (marker == 0) marker = mesh.segment_markers.of(i);
  }
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
  if (has_markers(mesh))
    for (PlanesInSpace::Part& part : planes.parts) mark(part, mesh);
  planes.points = std::move(mesh.vertices);
  planes.remarks = std::move(mesh.remarks);
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
  io::Watch watch(options, options.progress);
  const io::FileBytes bytes(path, &watch);
  io::Source source{path, bytes.view(), false, &watch, options.tolerance, true};
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
