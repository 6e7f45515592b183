#include "surface/facet_index.h"

#include <algorithm>
#include <tuple>

#include "numbers/sorted.h"

namespace holdfast {

FacetIndex::FacetIndex(std::size_t vertices, std::span<const Triangle> facets)
    : first_(vertices + 1, 0), entries_(facets.size()) {
  const auto least = [](const Triangle& t) { return std::min({t[0], t[1], t[2]}); };
  for (const Triangle& t : facets) ++first_[least(t) + 1];
  for (std::size_t v = 0; v < vertices; ++v) first_[v + 1] += first_[v];
  std::vector<Index> next(first_.begin(), first_.end() - 1);
  for (Index f = 0; f < facets.size(); ++f) {
    const Triangle t = ascending(facets[f]);
    entries_[next[t[0]]++] = {t[1], t[2], f};
  }
  const auto before = [](const Entry& x, const Entry& y) {
    return std::tie(x.middle, x.most, x.facet) < std::tie(y.middle, y.most, y.facet);
  };
  for (std::size_t v = 0; v < vertices; ++v)
    if (first_[v + 1] - first_[v] > 1)
      std::sort(entries_.begin() + first_[v], entries_.begin() + first_[v + 1], before);
}

Index FacetIndex::find(const Triangle& corners) const {
  const Triangle t = ascending(corners);
  const auto begin = entries_.begin() + first_[t[0]], end = entries_.begin() + first_[t[0] + 1];
  const auto it = std::lower_bound(begin, end, t, [](const Entry& e, const Triangle& wanted) {
    return std::pair(e.middle, e.most) < std::pair(wanted[1], wanted[2]);
  });
  return it != end && it->middle == t[1] && it->most == t[2] ? it->facet : no_index;
}

}  // namespace holdfast
