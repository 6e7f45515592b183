// Triangles of planes in space.
#include "plane/in_space.h"

#include <algorithm>
#include <stdexcept>

#include "plane/lift.h"
#include "plane/triangulate.h"
#include "text/decimal.h"

namespace holdfast::plane {
namespace {

using Part = PlanesInSpace::Part;

void add(PlaneReport& sum, const PlaneReport& part) {
  for (const auto member :
       {&PlaneReport::points, &PlaneReport::segments, &PlaneReport::holes, &PlaneReport::missing_segments,
        &PlaneReport::swaps, &PlaneReport::delaunay_swaps, &PlaneReport::partition_points, &PlaneReport::ears,
        &PlaneReport::joined, &PlaneReport::links, &PlaneReport::triangles, &PlaneReport::regions,
        &PlaneReport::field_points, &PlaneReport::segment_points, &PlaneReport::small_angles,
        &PlaneReport::small_angles_left, &PlaneReport::large_left})
    sum.*member += part.*member;
  sum.most_partition_points = std::max(sum.most_partition_points, part.most_partition_points);
  sum.least_angle = sum.least_angle == 0 ? part.least_angle : std::min(sum.least_angle, part.least_angle);
  sum.capped = sum.capped || part.capped;
  for (const auto& [stage, seconds] : part.seconds) sum.seconds[stage] += seconds;
}

class Together {
 public:
  explicit Together(const PlanesInSpace& planes) : planes_(planes) { sum_.mesh.in_space = planes.points; }

  /// Adds the triangles of a plane.
  void add_part(const Part& part, const PlaneResult& result) {
    const Lift lift(planes_, part);
    std::vector<Index> number = part.numbers;
    const PlaneMesh& mesh = result.mesh;
    for (std::size_t v = number.size(); v < mesh.points.size(); ++v) {
      number.push_back(static_cast<Index>(sum_.mesh.in_space.size()));
      sum_.mesh.in_space.push_back(lift(mesh.points[v]));
    }
    put_on_segments(part, mesh, lift, number);
    for (Triangle t : mesh.triangles) {
      if (part.turned) std::swap(t[1], t[2]);
      sum_.mesh.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
    }
    add_markers(mesh, number);
    const auto regions = static_cast<int>(sum_.report.regions);
    for (const int region : mesh.regions) sum_.mesh.regions.push_back(regions + region);
    for (const Segment& s : mesh.segments) sum_.mesh.segments.push_back({number[s[0]], number[s[1]]});
    add(sum_.report, result.report);
    if (planes_.parts.size() > 1) return;
    sum_.report.idle_holes = result.report.idle_holes;
    sum_.report.idle_seeds = result.report.idle_seeds;
  }

  /// The defects of a plane, with the vertex numbers of the file.
  PlaneResult refuse(const Part& part, PlaneResult&& result) const {
    const Lift lift(planes_, part);
    for (Defect& defect : result.defects) {
      std::string sides;
      std::vector<Index> vertices;
      for (const Index v : defect.vertices) vertices.push_back(part.numbers[v]);
      for (const Index s : defect.segments) {
        const auto [a, b] = part.plane.segments[s];
        sides += (sides.empty() ? "" : " and ") + std::to_string(part.numbers[a]) + "-" +
                 std::to_string(part.numbers[b]);
        vertices.insert(vertices.end(), {part.numbers[a], part.numbers[b]});
      }
      for (Point& where : defect.where) where = lift({where[0], where[1]});
      if (defect.kind == DefectKind::encloses_nothing) continue;
      defect.message = message_of(defect, vertices, sides);
      defect.vertices = std::move(vertices);
      defect.segments.clear();
    }
    return std::move(result);
  }

  PlaneResult take() { return std::move(sum_); }

 private:
  /// Adds the markers of a plane whose points, but not yet its segments, are there.
  void add_markers(const PlaneMesh& mesh, const std::vector<Index>& number) {
    std::vector<int>&of_points = sum_.mesh.point_markers, &of_segments = sum_.mesh.segment_markers;
    if (!of_points.empty() || !mesh.point_markers.empty()) of_points.resize(sum_.mesh.in_space.size(), 0);
    for (std::size_t v = 0; v < mesh.point_markers.size(); ++v)
      if (int& marker = of_points[number[v]]; marker == 0) marker = mesh.point_markers[v];
    if (of_segments.empty() && mesh.segment_markers.empty()) return;
    of_segments.resize(sum_.mesh.segments.size(), 0);
    of_segments.insert(of_segments.end(), mesh.segment_markers.begin(), mesh.segment_markers.end());
    of_segments.resize(sum_.mesh.segments.size() + mesh.segments.size(), 0);
  }
  // Pieces of segments come in order; their inner points lie on the segments and not on the mean plane.
  void put_on_segments(const Part& part, const PlaneMesh& mesh, const Lift& lift,
                       const std::vector<Index>& number) {
    std::size_t s = 0;
    for (const Segment& piece : mesh.segments) {
      if (s >= part.plane.segments.size()) return;
      const auto [a, b] = part.plane.segments[s];
      if (piece[1] == b)
        ++s;
      else if (piece[1] >= part.numbers.size())
        sum_.mesh.in_space[number[piece[1]]] = lift.on_segment(mesh.points[piece[1]], a, b);
    }
  }

  static std::string message_of(const Defect& defect, const std::vector<Index>& vertices,
                                const std::string& sides) {
    std::string place;
    if (!defect.where.empty()) {
      const Point& p = defect.where[0];
      place = " at (" + decimal(p[0], 6) + ", " + decimal(p[1], 6) + ", " + decimal(p[2], 6) + ")";
    }
    const std::string counted = " (points counted from 0)";
    switch (defect.kind) {
      case DefectKind::segments_cross:
        return "the sides " + sides + " cross" + place + counted + ": split both at a new point there";
      case DefectKind::segments_overlap:
        return "the sides " + sides + " overlap" + place + counted + ": split the longer one, or remove one";
      case DefectKind::vertex_in_segment:
        if (defect.vertices.empty())
          return "a hole" + place + " lies on the side " + sides + counted +
                 ": move it into the region to empty";
        return "point " + std::to_string(vertices[0]) + place + " lies inside the side " + sides + counted +
               ": split the side at this point";
      case DefectKind::repeated_vertex:
        return "points " + std::to_string(vertices[0]) + " and " + std::to_string(vertices[1]) +
               " fall together in their plane" + counted;
      default:
        return defect.message;
    }
  }

  const PlanesInSpace& planes_;
  PlaneResult sum_;
};

}  // namespace

PlaneResult triangulate(const PlanesInSpace& planes, const PlaneOptions& options, const Poll& poll) {
  if (planes.points.empty() && planes.parts.size() == 1)
    return triangulate(planes.parts[0].plane, options, poll);
  if (planes.parts.size() > 1 && (options.size > 0 || options.angle) && !options.keep_boundary)
    throw std::invalid_argument(
        "polygons in several planes can only be refined with their boundary kept, since they would not fit "
        "otherwise");
  Together together(planes);
  const auto count = static_cast<double>(planes.parts.size());
  for (std::size_t i = 0; i < planes.parts.size(); ++i) {
    const Part& part = planes.parts[i];
    PlaneResult result = triangulate(part.plane, options, [&](double share) {
      if (poll) poll((static_cast<double>(i) + share) / count);
    });
    if (result.outcome != Outcome::done) return together.refuse(part, std::move(result));
    together.add_part(part, result);
  }
  return together.take();
}

}  // namespace holdfast::plane
