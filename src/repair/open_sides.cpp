#include "repair/open_sides.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "repair/numbered_sides.h"
#include "surface/places.h"

namespace holdfast::repairing {

std::size_t open_sides(const State& state) {
  const std::vector<Index> first = first_at_places(state.vertices);
  std::vector<Triangle> facets;
  for (const Triangle& t : state.facets)
    if (std::all_of(t.begin(), t.end(), [&](Index v) { return v < first.size(); })) facets.push_back(t);
  const NumberedSides sides(facets, first);
  std::vector<std::uint32_t> count(sides.all.size(), 0);
  for (const std::array<Index, 3>& of_facet : sides.of_facets)
    for (const Index side : of_facet) ++count[side];
  return static_cast<std::size_t>(std::count(count.begin(), count.end(), 1u));
}

}  // namespace holdfast::repairing
