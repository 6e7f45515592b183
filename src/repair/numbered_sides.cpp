#include "repair/numbered_sides.h"

#include "arrange/index_table.h"
#include "numbers/sorted.h"

namespace holdfast::repairing {

NumberedSides::NumberedSides(std::span<const Triangle> facets, std::span<const Index> place) {
  arrange::IndexTable<2> numbers;
  of_facets.reserve(facets.size());
  for (const Triangle& t : facets) {
    std::array<Index, 3>& mine = of_facets.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const Side side = ascending(Side{place[t[i]], place[t[(i + 1) % 3]]});
      const auto next = static_cast<Index>(all.size());
      mine[i] = numbers.find_or_add(side, next);
      if (mine[i] == next) all.push_back(side);
    }
  }
}

}  // namespace holdfast::repairing
