#include "refine/limited_sizes.h"

#include <algorithm>
#include <limits>
#include <span>

#include "mesh/measure.h"
#include "refine/tets_inside.h"
#include "refine/tuning.h"

namespace holdfast {
namespace {

// What is found in some of the tetrahedra; volumes are multiplied by six.
struct Found {
  double all = 0, limited = 0, asked = 0;
  std::vector<LimitedSizes::AtFacet> facets;  // ascending
};

// The size that the corners of t pass on to its centroid.
double handed_on(const VolumeData& volume, const SizeFunction& sizes, Tet t, const Point& centre) {
  double size = std::numeric_limits<double>::infinity(), sum = 0;
  for (const Vertex v : volume.mesh.corners(t)) {
    size = std::min(size, volume.sizes[v] + sizes.gradation() * distance(volume.mesh.position(v), centre));
    sum += volume.sizes[v];
  }
  return sizes.grows() ? size : std::min(size, sum / 4);
}

// The facets of some samples, each once.
std::vector<LimitedSizes::AtFacet> joined(std::vector<LimitedSizes::AtFacet> samples) {
  std::stable_sort(samples.begin(), samples.end(),
                   [](const auto& f, const auto& g) { return f.facet < g.facet; });
  std::vector<LimitedSizes::AtFacet> facets;
  for (const LimitedSizes::AtFacet& s : samples) {
    if (facets.empty() || facets.back().facet != s.facet) {
      facets.push_back(s);
      continue;
    }
    LimitedSizes::AtFacet& f = facets.back();
    const double volume = f.volume + s.volume;
    if (s.bearable * f.wanted > f.bearable * s.wanted) f = s;
    f.volume = volume;
  }
  return facets;
}

// Samples a block, which is small, so that a user's function is asked about all of it at once.
Found found_in(const VolumeData& volume, const SizeFunction& sizes, std::span<const Tet> block) {
  std::vector<Point> places;
  std::vector<RegionId> regions;
  for (const Tet t : block) {
    places.push_back(centroid(volume.mesh, t));
    regions.push_back(volume.region_of[t]);
  }
  std::vector<double> limits(block.size());
  sizes.limits(places, regions, limits);
  Found found;
  for (std::size_t k = 0; k < block.size(); ++k) {
    const double six = six_volumes(volume.mesh, volume.mesh.corners(block[k]));
    const double wanted = std::min(limits[k], handed_on(volume, sizes, block[k], places[k]));
    const FacetSizes::By by = sizes.decider(wanted, regions[k]);
    const FacetSizes::Limit limit = sizes.of_facets().limit(places[k], wanted, by);
    const double asked = by == FacetSizes::By::user ? sizes.asked_for(wanted, regions[k]) : wanted;
    found.all += six;
    if (limit.facet == no_entity || !(limit.size > asked)) continue;
    found.limited += six;
    if (by == FacetSizes::By::user) found.asked += six;
    found.facets.push_back({limit.facet, asked, limit.size, places[k], six});
  }
  found.facets = joined(std::move(found.facets));
  return found;
}

}  // namespace

LimitedSizes limited_sizes(const VolumeData& volume, const SizeFunction& sizes, const Threads& threads) {
  if (sizes.of_facets().empty()) return {};
  const std::vector<Tet> tets = tets_inside(volume, threads);
  // Blocks are summed in their order, so the last bits do not depend on the threads.
  std::vector<Found> blocks((tets.size() + tuning::kFieldBlock - 1) / tuning::kFieldBlock);
  parallel(sizes.threads_of(threads), blocks.size(), [&](std::size_t b) {
    const std::size_t first = b * tuning::kFieldBlock;
    const std::size_t count = std::min(tuning::kFieldBlock, tets.size() - first);
    blocks[b] = found_in(volume, sizes, std::span(tets).subspan(first, count));
  });
  Found found;
  for (const Found& b : blocks) {
    found.all += b.all;
    found.limited += b.limited;
    found.asked += b.asked;
    found.facets.insert(found.facets.end(), b.facets.begin(), b.facets.end());
  }
  if (!(found.all > 0)) return {};
  LimitedSizes limited{found.limited / found.all, found.asked / found.all, joined(std::move(found.facets))};
  for (LimitedSizes::AtFacet& f : limited.facets) f.volume /= found.all;
  std::stable_sort(limited.facets.begin(), limited.facets.end(),
                   [](const auto& f, const auto& g) { return f.volume > g.volume; });
  return limited;
}

}  // namespace holdfast
