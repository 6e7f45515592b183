// The exact arrangement in the form that the caller receives.
#include "repair/exact_surface.h"

namespace holdfast::repairing {
namespace {

/// The quotient in lowest terms.
std::string quotient_text(const exact::BigInt& numerator, const exact::BigInt& denominator) {
  const exact::BigInt divisor = gcd(numerator, denominator);
  const exact::BigInt n = numerator / divisor, d = denominator / divisor;
  return n.str() + "/" + d.str();
}

}  // namespace

ExactSurface exact_surface(const arrange::Arrangement& arrangement, const Parents& of_state) {
  ExactSurface surface;
  for (const exact::PackedPoint& packed : arrangement.points) {
    const exact::SpacePoint p = packed.point();
    surface.points.push_back({quotient_text(p.x, p.w), quotient_text(p.y, p.w), quotient_text(p.z, p.w)});
  }
  surface.facets = arrangement.facets;
  surface.parents = lists_of(composed(of_state, arrangement.facet_parents));
  return surface;
}

ExactSurface exact_surface(const State& valid, const Parents& of_state) {
  ExactSurface surface;
  surface.facets = valid.facets;
  surface.parents = lists_of(of_state);
  return surface;
}

}  // namespace holdfast::repairing
