#include "recover/recover.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "mesh/editor.h"
#include "mesh/traverse.h"
#include "numbers/random.h"
#include "recover/tuning.h"

namespace holdfast {
FlipRecovery::FlipRecovery(TetMesh& mesh, const ConstraintSet& constraints, std::uint64_t seed)
    : mesh_(mesh),
      table_(constraints.table),
      facets_(constraints.facets),
      standing_(constraints.standing),
      random_(seed),
      piercing_(mesh, random_),
      flipper_(mesh, random_) {}

FlipStats FlipRecovery::run(const Tell& tell, int most_passes) {
  FlipStats stats;
  stats.missing_segments = standing_.missing_segments();
  stats.missing_facets = standing_.missing_facets();
  pass_over(
      standing_.segments, most_passes, [&](Index s, const Effort& effort) { return segment(s, effort); },
      tell);
  pass_over(
      standing_.facets, most_passes, [&](Index f, const Effort& effort) { return facet(f, effort); }, tell);
  stats.recovered_segments = stats.missing_segments - standing_.missing_segments();
  stats.recovered_facets = stats.missing_facets - standing_.missing_facets();
  stats.face_flips = flipper_.counts().face_flips;
  stats.edge_removals = flipper_.counts().edge_removals;
  return stats;
}

// Each pass goes twice as deep as the one before, with little work for each entity.
template <typename Attempt>
void FlipRecovery::pass_over(std::vector<std::uint8_t>& stands, int most_passes, Attempt attempt,
                             const Tell& tell) {
  std::vector<Index> missing;
  for (Index k = 0; k < stands.size(); ++k)
    if (stands[k] == 0) missing.push_back(k);
  int depth = 1, idle = 0;
  for (int pass = 1; pass <= most_passes && idle < tuning::kMostIdlePasses && !missing.empty(); ++pass) {
    const std::size_t before = missing.size(), work_before = flipper_.all_work();
    shuffle_in_blocks(missing);
    std::erase_if(missing, [&](Index k) {
      tell(static_cast<double>(pass) / most_passes);
      return attempt(k, {depth, tuning::kPassBudget, false});
    });
    if (flipper_.all_work() == work_before) return;  // no flips are left to try
    idle = tuning::kIdlePass * (before - missing.size()) > before ? 0 : idle + 1;
    depth = std::min(2 * depth, Flipper::kDeep);
  }
}

// In random order, because an attempt has a better chance after others have changed the mesh. In blocks,
// because close numbers are mostly close in space, so that the mesh there is in the caches.
void FlipRecovery::shuffle_in_blocks(std::vector<Index>& missing) {
  constexpr std::ptrdiff_t kBlock = tuning::kShuffledBlock;
  std::sort(missing.begin(), missing.end());
  for (auto first = missing.begin(); first != missing.end();) {
    const auto last = first + std::min(kBlock, missing.end() - first);
    numbers::shuffle(first, last, random_);
    first = last;
  }
}

// Clears the first crossing seen from a as long as possible, then the first one seen from b. A thorough
// attempt continues with the crossings in between.
bool FlipRecovery::segment(Index s, const Effort& effort) {
  enum class Way { open, blocked, invalid };
  Tet edge = kNone;
  const auto clear_first = [&](Vertex from, Vertex to) {
    while (true) {
      crossings_.clear();
      const std::optional<Tet> last = piercing_.by_segment(from, to, crossings_, 1);
      if (!last) return Way::invalid;
      edge = *last;
      if (crossings_.empty()) return Way::open;
      if (!flipper_.clear(crossings_.front(), effort.depth, effort.budget)) return Way::blocked;
    }
  };
  const auto [a, b] = table_.segments[s];
  flipper_.aim(Target::segment(a, b));
  Way way = Way::blocked;
  do {
    way = clear_first(a, b);
    if (way == Way::blocked) way = clear_first(b, a);
  } while (way == Way::blocked && effort.thorough && clear_between(a, b, effort));
  if (way != Way::open) return false;
  MeshEditor(mesh_).set_segment(edge, a, b);
  standing_.segments[s] = 1;
  return true;
}

// Tries the crossings in random order; returns whether one could be cleared.
bool FlipRecovery::clear_between(Vertex a, Vertex b, const Effort& effort) {
  crossings_.clear();
  piercing_.by_segment(a, b, crossings_, tuning::kMostCrossings);
  numbers::shuffle(crossings_.begin(), crossings_.end(), random_);
  return std::any_of(crossings_.begin(), crossings_.end(), [&](const Crossing& c) {
    return flipper_.stands(c) && flipper_.clear(c, effort.depth, effort.budget);
  });
}

bool FlipRecovery::facet(Index f, const Effort& effort) {
  for (const Index s : table_.facet_segments[f])
    if (standing_.segments[s] == 0) return false;
  flipper_.aim(Target::facet(facets_[f]));
  std::size_t failures = 0;
  for (bool gained = true; gained;) {
    gained = false;
    edges_.clear();
    const std::optional<Face> face = piercing_.of_facet(facets_[f], edges_, tuning::kMostCrossings);
    if (!face || edges_.size() > tuning::kMostPiercing) return false;
    if (edges_.empty()) {
      if (*face == kNone) return false;
      MeshEditor(mesh_).set_facet(*face);
      standing_.facets[f] = 1;
      return true;
    }
    numbers::shuffle(edges_.begin(), edges_.end(), random_);
    for (const PiercingEdge& e : edges_) {
      const Crossing crossing{e.tet, {e.above, e.below}, 2};
      if (!flipper_.stands(crossing)) continue;
      const bool cleared = flipper_.clear(crossing, effort.depth, effort.budget);
      gained |= cleared;
      if (!cleared && ++failures == tuning::kMostFlipFailures) return false;
    }
  }
  return false;
}

}  // namespace holdfast
