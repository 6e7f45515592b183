#include "api/judge.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace holdfast {

void require_sensible(const Complex& complex, const Options& options) {
  const auto finite = [](const Point& p) {
    return std::all_of(p.begin(), p.end(), [](double x) { return std::isfinite(x); });
  };
  if (!complex.vertex_markers.empty() && complex.vertex_markers.size() != complex.vertices.size())
    throw std::invalid_argument("as many vertex markers as vertices are needed, or none");
  if (!complex.facet_markers.empty() && complex.facet_markers.size() != complex.facets.size())
    throw std::invalid_argument("as many facet markers as facets are needed, or none");
  if (!complex.segment_markers.empty() && complex.segment_markers.size() != complex.segments.size())
    throw std::invalid_argument("as many segment markers as segments are needed, or none");
  if (!std::all_of(options.holes.begin(), options.holes.end(), finite))
    throw std::invalid_argument("a hole has a coordinate that is not finite");
  if (!std::all_of(options.regions.begin(), options.regions.end(),
                   [&](const RegionSeed& seed) { return finite(seed.where); }))
    throw std::invalid_argument("a region seed has a coordinate that is not finite");
  if (options.sizes) {
    const Sizes& sizes = *options.sizes;
    if (!(sizes.size >= 0) || !(sizes.gradation >= 0 && sizes.gradation <= 1))
      throw std::invalid_argument("a size must not be negative, and the gradation lie between 0 and 1");
    if (!sizes.vertex_sizes.empty() && sizes.vertex_sizes.size() != complex.vertices.size())
      throw std::invalid_argument("as many sizes as vertices are needed, or none");
  }
  if (options.keep == Keep::box && !(options.box_margin > 0 && options.box_margin < 1e6))
    throw std::invalid_argument("the margin of the box must be positive and below a million");
}

}  // namespace holdfast
