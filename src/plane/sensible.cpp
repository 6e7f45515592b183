// Options that make sense, alone and together.
#include "plane/sensible.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace holdfast::plane {
namespace {

constexpr double kMostAngle = 34;

void require_sensible_refinement(const PlaneOptions& options) {
  if (!(options.size >= 0) || std::isinf(options.size))
    throw std::invalid_argument("the size of edges must be positive and finite, or 0 for none");
  if (options.angle && !(*options.angle >= 0 && *options.angle <= kMostAngle))
    throw std::invalid_argument("the least angle must be from 0 to 34 degrees");
  if (options.keep_boundary && !refines(options))
    throw std::invalid_argument("without a size or an angle no point is added on the boundary anyway");
  if (refines(options) && options.stop_after)
    throw std::invalid_argument("a run that ends after a stage is not refined");
}

}  // namespace

void require_sensible(const Plane& plane, const PlaneOptions& options) {
  const auto fits = [](const auto& markers, const auto& entities) {
    return markers.empty() || markers.size() == entities.size();
  };
  if (!fits(plane.point_markers, plane.points))
    throw std::invalid_argument("as many point markers as points are needed, or none");
  if (!fits(plane.segment_markers, plane.segments))
    throw std::invalid_argument("as many segment markers as segments are needed, or none");
  if (plane.points.size() > kMostPoints) throw std::length_error("more than 2^28 points are too many");
  const auto finite = [](const PlanePoint& p) { return std::isfinite(p[0]) && std::isfinite(p[1]); };
  for (std::size_t i = 0; i < plane.holes.size(); ++i)
    if (!finite(plane.holes[i]))
      throw std::invalid_argument("hole " + std::to_string(i + 1) + " is not finite");
  for (std::size_t i = 0; i < plane.regions.size(); ++i)
    if (!finite(plane.regions[i].where))
      throw std::invalid_argument("region " + std::to_string(i + 1) + " is not finite");
  if (options.stop_after == PlaneStage::partition && options.method != PlaneMethod::partition)
    throw std::invalid_argument("only the method partition has the stage partition");
  if (options.stop_after == PlaneStage::swap && options.method != PlaneMethod::swaps)
    throw std::invalid_argument("only the method swaps has the stage swap");
  if (options.order && options.method == PlaneMethod::ears)
    throw std::invalid_argument("the method ears lays no segments one by one");
  require_sensible_refinement(options);
}

}  // namespace holdfast::plane
