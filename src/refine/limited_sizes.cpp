#include "refine/limited_sizes.h"

#include <algorithm>
#include <span>

#include "mesh/measure.h"
#include "refine/tets_inside.h"
#include "refine/tuning.h"

namespace holdfast {
namespace {

struct Sample {
  Point place;
  double volume;  // six times it
  double wanted;
  bool is_asked = false;
  FacetSizes::Limit limit{0, no_entity};
};

// What the corners of t hand on to its centroid.
double handed_on(const VolumeData& volume, const SizeFunction& sizes, Tet t, const Point& centre) {
  double size = std::numeric_limits<double>::infinity(), sum = 0;
  for (const Vertex v : volume.mesh.corners(t)) {
    size = std::min(size, volume.sizes[v] + sizes.gradation() * distance(volume.mesh.position(v), centre));
    sum += volume.sizes[v];
  }
  return sizes.grows() ? size : std::min(size, sum / 4);
}

std::vector<Sample> samples_of(const VolumeData& volume, const SizeFunction& sizes,
                               const std::vector<Tet>& tets, const Threads& threads) {
  std::vector<Sample> samples(tets.size());
  parallel_ranges(sizes.threads_of(threads), tets.size(), [&](std::size_t first, std::size_t last) {
    std::vector<Point> places;
    std::vector<RegionId> regions;
    std::vector<double> limits;
    while (first < last) {
      const auto block = std::span(tets).subspan(first, std::min(tuning::kFieldBlock, last - first));
      places.clear();
      regions.clear();
      for (const Tet t : block) {
        places.push_back(centroid(volume.mesh, t));
        regions.push_back(volume.region_of[t]);
      }
      limits.resize(block.size());
      sizes.limits(places, regions, limits);
      for (std::size_t k = 0; k < block.size(); ++k) {
        const Tet t = block[k];
        const Point& x = places[k];
        const double wanted = std::min(limits[k], handed_on(volume, sizes, t, x));
        const FacetSizes::By by = sizes.decider(wanted, regions[k]);
        samples[first + k] = {x, six_volumes(volume.mesh, volume.mesh.corners(t)), wanted,
                              by == FacetSizes::By::user, sizes.of_facets().limit(x, wanted, by)};
      }
      first += block.size();
    }
  });
  return samples;
}

std::vector<LimitedSizes::AtFacet> by_facet(std::vector<Sample>& limited) {
  // Sums do not depend on the order in which the facets' samples come.
  std::stable_sort(limited.begin(), limited.end(),
                   [](const Sample& x, const Sample& y) { return x.limit.facet < y.limit.facet; });
  std::vector<LimitedSizes::AtFacet> facets;
  for (const Sample& s : limited) {
    if (facets.empty() || facets.back().facet != s.limit.facet)
      facets.push_back({s.limit.facet, s.wanted, s.limit.size, s.place, 0});
    LimitedSizes::AtFacet& f = facets.back();
    f.volume += s.volume;
    if (s.limit.size * f.wanted > f.bearable * s.wanted)
      f = {f.facet, s.wanted, s.limit.size, s.place, f.volume};
  }
  std::stable_sort(facets.begin(), facets.end(),
                   [](const auto& f, const auto& g) { return f.volume > g.volume; });
  return facets;
}

}  // namespace

LimitedSizes limited_sizes(const VolumeData& volume, const SizeFunction& sizes, const Threads& threads) {
  LimitedSizes found;
  if (sizes.of_facets().empty()) return found;
  std::vector<Sample> samples = samples_of(volume, sizes, tets_inside(volume, threads), threads);
  double all = 0;
  for (const Sample& s : samples) all += s.volume;
  std::erase_if(samples, [](const Sample& s) { return s.limit.facet == no_entity; });
  for (const Sample& s : samples) {
    found.volume += s.volume;
    if (s.is_asked) found.asked_volume += s.volume;
  }
  found.facets = by_facet(samples);
  if (!(all > 0)) return found;
  found.volume /= all;
  found.asked_volume /= all;
  for (LimitedSizes::AtFacet& f : found.facets) f.volume /= all;
  return found;
}

}  // namespace holdfast
