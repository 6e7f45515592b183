// Recovers all segments, then all facets, each group in random order unless the options give another. The
// points of one constraint are eliminated before the next one is partitioned; otherwise points lead to more
// points (paper §2.4). A missing segment has no facet yet, so its points are eliminated as those of a
// dangling segment, whatever its final degree. After that, every missing facet has three single edges as
// sides.
#include "enforce/enforce.h"

#include <functional>
#include <random>

#include "enforce/by_cavities.h"
#include "enforce/partition.h"
#include "enforce/steiner_points.h"
#include "enforce/tuning.h"
#include "numbers/halving.h"
#include "numbers/random.h"
#include "recover/facet_cavities.h"
#include "recover/recover.h"

namespace holdfast {
namespace {

// A way to recover a missing constraint; returns whether the constraint now stands.
using Way = std::function<bool(Index)>;

// Tries the ways in order; the last one never fails.
void lay_by_first_way(const std::vector<Way>& ways, Index constraint) {
  for (const Way& way : ways)
    if (way(constraint)) return;
}

std::vector<Index> missing_in_order(LayingOrder order, const std::vector<std::uint8_t>& stands,
                                    Random& random) {
  std::vector<Index> missing;
  for (Index k = 0; k < stands.size(); ++k)
    if (stands[k] == 0) missing.push_back(k);
  if (order == LayingOrder::random) numbers::shuffle(missing.begin(), missing.end(), random);
  return order == LayingOrder::halving ? numbers::halved(missing) : missing;
}

}  // namespace

EnforceStats enforce(TetMesh& mesh, const SegmentTable& table, std::span<const Triangle> facets,
                     Standing& standing, Vertex first_free, const EnforceOptions& options, Monitor& monitor) {
  EnforceStats stats;
  Random random(options.seed);
  const std::vector<Index> missing_segments = missing_in_order(options.order, standing.segments, random);
  const std::vector<Index> missing_facets = missing_in_order(options.order, standing.facets, random);
  const auto all = static_cast<double>(missing_segments.size() + missing_facets.size());
  std::size_t laid = 0;
  const std::function<void()> tell = [&] {
    monitor.poll(options.eliminate ? Stage::eliminate : Stage::partition, static_cast<double>(laid) / all);
  };
  SteinerPoints steiner(mesh, first_free, random);

  FlipRecovery flips(mesh, table, facets, standing, options.seed);
  const Way segment_by_flips = [&](Index s) { return flips.segment(s, tuning::kRetry); };
  const Way facet_by_flips = [&](Index f) { return flips.facet(f, tuning::kRetry); };

  // Cavities need no point for each edge that pierces the facet. The fewer edges pierce it, the less flips
  // cost.
  FacetCavities cavities(mesh, options.seed);
  const Way facet_by_few_flips = [&](Index f) {
    return cavities.crossing(facets[f]) < tuning::kManyCrossing && facet_by_flips(f);
  };
  const FacetCavities::Finish finish = [&](TetMesh& cavity, const SegmentTable& its_table,
                                           std::span<const Triangle> its_facets, Standing& its_standing,
                                           Vertex its_first_free) {
    const EnforceStats inside = enforce(cavity, its_table, its_facets, its_standing, its_first_free,
                                        {.seed = random(), .cavities = false}, monitor);
    stats.segment_points += inside.segment_points;
    stats.facet_points += inside.facet_points;
  };
  const Way facet_by_cavities = [&](Index f) {
    if (!recover_by_cavities(mesh, cavities, facets[f], steiner, tell, finish)) return false;
    standing.facets[f] = 1;
    return true;
  };

  Partition partition(mesh, table, facets, first_free, random, tell);
  const Way segment_by_partition = [&](Index s) {
    stats.segment_points += partition.cut_segment(s);
    if (options.eliminate) partition.eliminate_from_segment(s, steiner);
    standing.segments[s] = 1;
    return true;
  };
  const Way facet_by_partition = [&](Index f) {
    stats.facet_points += partition.cut_facet(f);
    if (options.eliminate) partition.eliminate_from_facet(steiner);
    standing.facets[f] = 1;
    return true;
  };

  std::vector<Way> for_segments, for_facets;
  if (options.flips && options.eliminate) {
    // One by one: if memory runs out in a list of several, g++ 12 destroys an element that it has not made.
    for_segments.push_back(segment_by_flips);
    for_facets.push_back(options.cavities ? facet_by_few_flips : facet_by_flips);
    if (options.cavities) for_facets.push_back(facet_by_cavities);
  }
  for_segments.push_back(segment_by_partition);
  for_facets.push_back(facet_by_partition);

  const auto lay_all = [&](const std::vector<Index>& missing, const std::vector<Way>& ways) {
    for (const Index k : missing) {
      tell();
      lay_by_first_way(ways, k);
      ++laid;
    }
  };
  lay_all(missing_segments, for_segments);
  lay_all(missing_facets, for_facets);
  stats.pieces = partition.take_pieces();
  return stats;
}

}  // namespace holdfast
