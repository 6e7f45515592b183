// Triangles in the plane between points that may be exact.
#include "plane/exact_plane.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "plane/methods.h"
#include "plane/regions.h"
#include "plane/sensible.h"

namespace holdfast::plane {
namespace {

bool is_sound(const ExactPlane& plane) {
  const auto finite = [](const Points& points) {
    return std::all_of(points.positions().begin(), points.positions().end(),
                       [](const Position& p) { return std::isfinite(p[0]) && std::isfinite(p[1]); });
  };
  return finite(plane.points) && finite(plane.holes) &&
         std::all_of(plane.segments.begin(), plane.segments.end(), [&](const Segment& s) {
           return s[0] < plane.points.size() && s[1] < plane.points.size() && s[0] != s[1];
         });
}

/// Whether any points or segments meet other than in common ends. This needs a test of its own if all points
/// are collinear, because then no triangles show it.
bool meets_itself(const ExactPlane& plane, const Poll& poll) {
  PlaneOptions options;
  options.method = PlaneMethod::ears;
  PlaneResult result;
  Stages stages(poll, result.report.seconds);
  return !triangles_by_method(plane.points, plane.segments, options, result, stages);
}

bool lies_on_segment(const ExactPlane& plane, Vertex hole, Draft& draft) {
  const std::size_t before = draft.points.size();
  const Vertex v = draft.points.add(plane.holes, hole);
  const bool on = std::any_of(draft.segments.begin(),
                              draft.segments.begin() + static_cast<std::ptrdiff_t>(plane.segments.size()),
                              [&](const Ends& s) {
                                return draft.points.orient(s[0], s[1], v) == 0 &&
                                       draft.points.compare(s[0], v) * draft.points.compare(s[1], v) <= 0;
                              });
  draft.points.shrink(before);
  return on;
}

/// By region, whether it is kept; nullopt if a hole lies on a segment. A hole may lie on a side of the hull
/// that is no segment, and ears leave out segments that bound nothing.
std::optional<std::vector<bool>> kept_regions(const ExactPlane& plane, Draft& draft, const Regions& regions) {
  std::vector<bool> kept(regions.count + std::size_t{1}, true);
  kept[kOutside] = false;
  const std::vector<Found> found = find_triangles(draft.mesh, draft.points, plane.holes);
  for (Vertex hole = 0; hole < found.size(); ++hole) {
    const auto [triangle, on_constraint] = found[hole];
    if (triangle != kNoVertex && !on_constraint)
      kept[regions.of_triangle[triangle]] = false;
    else if (lies_on_segment(plane, hole, draft))
      return std::nullopt;
  }
  return kept;
}

}  // namespace

std::optional<std::vector<Corners3>> triangulate(const ExactPlane& plane, const PlaneOptions& options,
                                                 PlaneReport& report, const Poll& poll) {
  if (refines(options) || options.stop_after)
    throw std::invalid_argument("triangles between exact points are neither refined nor those of a stage");
  if (!is_sound(plane)) return std::nullopt;
  PlaneResult result;
  Stages stages(poll, result.report.seconds);
  std::optional<Draft> draft = triangles_by_method(plane.points, plane.segments, options, result, stages);
  if (!draft || (draft->mesh.size() == 0 && meets_itself(plane, poll))) return std::nullopt;
  const Regions regions = find_regions(draft->mesh);
  const std::optional<std::vector<bool>> kept = kept_regions(plane, *draft, regions);
  if (!kept) return std::nullopt;
  std::vector<Corners3> triangles;
  for (std::size_t t = 0; t < draft->mesh.size(); ++t) {
    if (!(*kept)[regions.of_triangle[t]]) continue;
    const Corners3& v = draft->mesh[t].v;
    triangles.push_back({draft->number(v[0]), draft->number(v[1]), draft->number(v[2])});
  }
  report = std::move(result.report);
  report.triangles = triangles.size();
  return triangles;
}

}  // namespace holdfast::plane
