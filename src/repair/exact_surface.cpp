// The exact arrangement as it is told to the caller.
#include "repair/exact_surface.h"

#include "numbers/sorted.h"

namespace holdfast::repairing {
namespace {

/// The quotient in lowest terms.
std::string quotient_text(const exact::BigInt& numerator, const exact::BigInt& denominator) {
  const exact::BigInt divisor = gcd(numerator, denominator);
  const exact::BigInt n = numerator / divisor, d = denominator / divisor;
  return n.str() + "/" + d.str();
}

}  // namespace

ExactSurface exact_surface(const State& before, const arrange::Arrangement& arrangement) {
  ExactSurface surface;
  for (const exact::SpacePoint& p : arrangement.points)
    surface.points.push_back({quotient_text(p.x, p.w), quotient_text(p.y, p.w), quotient_text(p.z, p.w)});
  surface.facets = arrangement.facets;
  std::vector<Index> list;
  for (std::size_t f = 0; f < arrangement.facet_parents.size(); ++f) {
    list.clear();
    for (const Index p : arrangement.facet_parents.of(f)) {
      const auto of = before.facet_parents.of(p);
      list.insert(list.end(), of.begin(), of.end());
    }
    sort_unique(list);
    surface.parents.all.insert(surface.parents.all.end(), list.begin(), list.end());
    surface.parents.first.push_back(surface.parents.all.size());
  }
  return surface;
}

ExactSurface exact_surface(const State& valid) {
  ExactSurface surface;
  surface.facets = valid.facets;
  surface.parents.first.assign(valid.facet_parents.first.begin(), valid.facet_parents.first.end());
  surface.parents.all = valid.facet_parents.all;
  return surface;
}

}  // namespace holdfast::repairing
