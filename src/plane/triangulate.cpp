// From points and segments to triangles: the course of a run.
#include "plane/triangulate.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "plane/chosen.h"
#include "plane/defects.h"
#include "plane/kept.h"
#include "plane/methods.h"
#include "plane/refine.h"
#include "plane/sensible.h"
#include "plane/shape.h"

namespace holdfast::plane {
namespace {

constexpr double kAngleOfSizes = 20;
constexpr std::size_t kMostDefects = 100;  // of a kind
constexpr double kRegions = 0.9;           // share of the work at its end

/// The requirements on single entities without which no stage can begin.
bool is_sound(const Plane& plane) {
  const auto finite = [](const PlanePoint& p) { return std::isfinite(p[0]) && std::isfinite(p[1]); };
  return std::all_of(plane.points.begin(), plane.points.end(), finite) &&
         std::all_of(plane.segments.begin(), plane.segments.end(), [&](const Segment& s) {
           return s[0] < plane.points.size() && s[1] < plane.points.size() && s[0] != s[1];
         });
}

void encloses_nothing(const Plane& plane, PlaneResult& result) {
  result.mesh = {};
  result.outcome = Outcome::invalid_input;
  result.message = plane.segments.empty() ? "all points lie on one line, so that there is no triangle"
                                          : "the segments enclose nothing, or nothing but holes";
  result.defects.push_back({DefectKind::encloses_nothing, {}, {}, {}, {}, result.message});
}

/// After Delaunay and some swaps: the segments that are not edges yet.
void tell_missing(Draft& draft, const Plane& plane, PlaneResult& result) {
  draft.mesh.find_stars(draft.points.size());
  std::vector<Segment>& missing = result.intermediate.missing_segments;
  for (Index s = 0; s < draft.segments.size(); ++s)
    if (draft.mesh.find_edge(draft.segments[s][0], draft.segments[s][1]) == kNoEdge)
      missing.push_back(plane.segments[s]);
  result.report.missing_segments = missing.size();
}

// --- The kept triangles ---

/// Takes the triangles for which `kept` is true, with the region given by `id`.
template <typename Kept, typename Id>
void deliver(const Draft& draft, const Plane& plane, PlaneResult& result, Kept&& kept, Id&& id) {
  const Points& points = draft.points;
  PlaneMesh& mesh = result.mesh;
  mesh.triangles.reserve(draft.mesh.size());
  mesh.regions.reserve(draft.mesh.size());
  LeastAngle least(points.positions());
  for (std::uint32_t t = 0; t < draft.mesh.size(); ++t) {
    if (draft.mesh.is_ghost(t) || !kept(t)) continue;
    const std::array<Vertex, 3>& v = draft.mesh[t].v;
    mesh.triangles.push_back({draft.number(v[0]), draft.number(v[1]), draft.number(v[2])});
    mesh.regions.push_back(id(t));
    least.take(points[v[0]], points[v[1]], points[v[2]]);
  }
  if (!mesh.triangles.empty()) result.report.least_angle = least.degrees();
  mesh.points = plane.points;
  mesh.point_markers = plane.point_markers;
  mesh.segments = plane.segments;
  mesh.segment_markers = plane.segment_markers;
  // Added points; those of the partition are rounded to the nearest doubles.
  for (std::size_t v = plane.points.size(); v < points.size(); ++v)
    mesh.points.push_back(points[static_cast<Vertex>(v)]);
  if (!mesh.point_markers.empty()) mesh.point_markers.resize(mesh.points.size(), 0);
  result.report.triangles = mesh.triangles.size();
}

Refined refine_kept(Draft& draft, const PlaneOptions& options, std::vector<double> areas, PlaneReport& report,
                    const Poll& poll) {
  const RefineOptions wanted{.angle = options.angle.value_or(kAngleOfSizes),
                             .size = options.size,
                             .areas = std::move(areas),
                             .keep_boundary = options.keep_boundary,
                             .most_points = std::min(options.max_points, kMostPoints - draft.points.size())};
  Refined refined = refine(draft.mesh, draft.points, draft.segments, wanted, poll);
  report.field_points = refined.inside;
  report.segment_points = refined.on_segments.size() + refined.on_others;
  report.small_angles = refined.small_input;
  report.small_angles_left = refined.small_left;
  report.large_left = refined.large_left;
  report.capped = refined.capped;
  return refined;
}

/// Returns false if a hole or seed lies on a segment.
bool keep_regions(Draft& draft, const Plane& plane, const PlaneOptions& options, PlaneResult& result,
                  Stages& stages, const Poll& poll) {
  const Chosen chosen = stages.run("regions", kRegions, [&](const Poll&) {
    Chosen found = choose_regions(draft, plane, options.method);
    if (found.on_constraint) result.defects = find_defects(plane, kMostDefects, poll);
    return found;
  });
  result.report.regions = chosen.count();
  result.report.idle_holes = chosen.idle_holes;
  result.report.idle_seeds = chosen.idle_seeds;
  if (!result.defects.empty()) return false;
  if (refines(options)) {
    draft.mesh = kept_part(draft.mesh, chosen.regions, chosen.kept);
    const Refined refined = stages.run("refine", 1, [&](const Poll& share) {
      return refine_kept(draft, options, chosen.areas, result.report, share);
    });
    deliver(
        draft, plane, result, [](std::uint32_t) { return true; },
        [&](std::uint32_t t) { return chosen.ids[draft.mesh[t].mark]; });
    cut_segments(plane, refined, result.mesh);
  } else {
    deliver(
        draft, plane, result, [&](std::uint32_t t) { return chosen.keeps(t); },
        [&](std::uint32_t t) { return chosen.id_of(t); });
  }
  if (result.mesh.triangles.empty()) encloses_nothing(plane, result);
  return true;
}

// --- The run ---

/// Returns false if the input turns out to be invalid.
bool make(const Plane& plane, const PlaneOptions& options, PlaneResult& result, const Poll& poll) {
  Stages stages(poll, result.report.seconds);
  const bool by_ears = options.method == PlaneMethod::ears;
  std::optional<Draft> draft = triangles_by_method(plane.points, plane.segments, options, result, stages);
  if (!draft) return false;
  if (!by_ears && draft->mesh.size() == 0) {
    // Collinear points have no triangles, but they may still be invalid.
    result.defects = find_defects(plane, kMostDefects, poll);
    if (!result.defects.empty()) return false;
    encloses_nothing(plane, result);
    return true;
  }
  if (options.stop_after && !by_ears) {
    if (options.stop_after != PlaneStage::partition) tell_missing(*draft, plane, result);
    deliver(
        *draft, plane, result, [](std::uint32_t) { return true; }, [](std::uint32_t) { return 1; });
    return true;
  }
  return keep_regions(*draft, plane, options, result, stages, poll);
}

void refuse(const Plane& plane, PlaneResult& result, const Poll& poll) {
  if (result.defects.empty()) result.defects = find_defects(plane, kMostDefects, poll);
  if (result.defects.empty()) throw std::logic_error("holdfast: a plane input fails without a defect");
  result.mesh = {};
  result.intermediate = {};
  result.outcome = Outcome::invalid_input;
  result.message = "the points and segments are not valid";
}

}  // namespace

PlaneResult triangulate(const Plane& plane, const PlaneOptions& options, const Poll& poll) {
  require_sensible(plane, options);
  PlaneResult result;
  result.report.points = plane.points.size();
  result.report.segments = plane.segments.size();
  result.report.holes = plane.holes.size();
  double total = 0;
  {
    const Stages::Timer timer{total};
    if (!is_sound(plane) || !make(plane, options, result, poll)) refuse(plane, result, poll);
  }
  result.report.seconds["total"] = total;
  result.mesh.base = plane.base;
  return result;
}

}  // namespace holdfast::plane
