#include "repair/open_sides.h"

#include <algorithm>
#include <vector>

#include "surface/places.h"

namespace holdfast::repairing {

std::size_t open_sides(const State& state) {
  const std::vector<Index> first = first_at_places(state.vertices);
  std::vector<Segment> sides;
  for (const Triangle& t : state.facets) {
    if (std::any_of(t.begin(), t.end(), [&](Index v) { return v >= first.size(); })) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(first[t[i]], first[t[(i + 1) % 3]]);
      sides.push_back({a, b});
    }
  }
  std::sort(sides.begin(), sides.end());
  std::size_t open = 0;
  for (std::size_t k = 0, next = 0; k < sides.size(); k = next) {
    while (next < sides.size() && sides[next] == sides[k]) ++next;
    open += next - k == 1 ? 1 : 0;
  }
  return open;
}

}  // namespace holdfast::repairing
