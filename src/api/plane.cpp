// The public functions of holdfast/plane.h: limits and outcomes around the work of src/plane.
#include "holdfast/plane.h"

#include <cmath>
#include <new>
#include <stdexcept>
#include <string>

#include "mesh/limit_message.h"
#include "mesh/plain_monitor.h"
#include "numbers/float_environment.h"
#include "plane/defects.h"
#include "plane/facets.h"
#include "plane/in_space.h"
#include "plane/triangulate.h"

namespace holdfast {
namespace {

PlaneResult ended(Outcome outcome, const Limits& limits) {
  PlaneResult result;
  result.outcome = outcome;
  result.message = limit_message(outcome, limits);
  return result;
}

template <typename Input>
PlaneResult within_limits(const Input& input, const PlaneOptions& options) {
  const FloatEnvironment environment;
  try {
    PlainMonitor monitor(options, options.progress);
    monitor.tell(0);
    PlaneResult result = plane::triangulate(input, options, [&](double fraction) { monitor.poll(fraction); });
    if (result.outcome == Outcome::done) result.mesh.names = input.names;
    monitor.tell(1);
    return result;
  } catch (const Interrupted& interrupted) {
    return ended(interrupted.outcome(), options);
  } catch (const std::bad_alloc&) {
    if (options.memory_limit == 0) throw;
    return ended(Outcome::memory_limit, options);
  }
}

}  // namespace

PlaneResult triangulate(const Plane& plane, const PlaneOptions& options) {
  return within_limits(plane, options);
}

PlaneResult triangulate(const PlanesInSpace& planes, const PlaneOptions& options) {
  return within_limits(planes, options);
}

PlanesInSpace plane_in_space(std::span<const Point> points, std::span<const Segment> segments,
                             std::span<const Point> holes, double tolerance,
                             std::span<const int> point_markers, std::span<const int> segment_markers) {
  const FloatEnvironment environment;
  if (!(tolerance >= 0) || std::isinf(tolerance))
    throw std::invalid_argument("the tolerance must be finite and not negative");
  if ((!point_markers.empty() && point_markers.size() != points.size()) ||
      (!segment_markers.empty() && segment_markers.size() != segments.size()))
    throw std::invalid_argument("there must be as many markers as points or segments, or none");
  plane::PolygonFacet all;
  all.holes.assign(holes.begin(), holes.end());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    for (const Index v : segments[i])
      if (v >= points.size())
        throw std::invalid_argument("segment " + std::to_string(i) + " names point " + std::to_string(v) +
                                    ", but there are " + std::to_string(points.size()) + " points");
    all.polygons.push_back({segments[i][0], segments[i][1]});
  }
  for (Index v = 0; v < points.size(); ++v) all.polygons.push_back({v});
  plane::FoundPlanes found = plane::planes_of(points, {std::move(all)}, tolerance, {});
  if (!found.reason.empty()) throw std::invalid_argument("the points: " + found.reason);
  for (PlanesInSpace::Part& part : found.planes.parts)
    plane::mark(part, points, point_markers, segments, segment_markers);
  found.planes.points.assign(points.begin(), points.end());
  return std::move(found.planes);
}

std::vector<Defect> diagnose(const Plane& plane, std::size_t most) {
  const FloatEnvironment environment;
  return plane::find_defects(plane, most, {});
}

}  // namespace holdfast
