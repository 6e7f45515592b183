// Surface layer: vertices used by no element.
#include "surface/isolated.h"

#include <algorithm>
#include <cstdint>

#include "surface/places.h"

namespace holdfast {

std::vector<Index> isolated_vertices(const Complex& complex) {
  std::vector<std::uint8_t> used(complex.vertices.size(), 0);
  const auto mark = [&](const auto& entities) {
    for (const auto& corners : entities)
      for (const Index v : corners) used[v] = 1;
  };
  mark(complex.facets);
  mark(complex.segments);
  std::vector<Index> isolated;
  for (Index v = 0; v < used.size(); ++v)
    if (used[v] == 0) isolated.push_back(v);
  if (isolated.empty()) return isolated;
  const Places places = places_of(complex);
  std::erase_if(isolated, [&](Index v) { return places.first[v] != v; });
  return isolated;
}

}  // namespace holdfast
