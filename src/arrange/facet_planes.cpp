// The planes of facets.
#include "arrange/facet_planes.h"

namespace holdfast::arrange {

FacetPlanes::FacetPlanes(const Complex& complex, const Elements& elements,
                         const std::vector<std::uint8_t>& used, const Threads& threads)
    : plane_(used.size(), no_index) {
  std::vector<Index> facets;
  for (Index i = 0; i < used.size(); ++i) {
    if (used[i] == 0) continue;
    plane_[i] = static_cast<Index>(facets.size());
    facets.push_back(i);
  }
  planes_.resize(facets.size());
  parallel_ranges(threads, facets.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      const auto& [a, b, c] = elements.all[facets[k]].vertex;
      const auto at = [&](Index v) { return complex.vertices[v].data(); };
      planes_[k] = exact::plane_through(at(a), at(b), at(c));
    }
  });
}

}  // namespace holdfast::arrange
