#include "untangle/make_positive.h"

#include "untangle/relocate.h"
#include "untangle/smooth.h"
#include "untangle/swap.h"
#include "untangle/tuning.h"

namespace holdfast {
namespace {

bool is_tangled(const Tangle& tangle) { return tangle.nonpositive_count() > 0; }

// The share of the tetrahedra that are not positive.
double share_tangled(const Tangle& tangle) {
  return static_cast<double>(tangle.nonpositive_count()) / static_cast<double>(tangle.tet_count());
}

void relocate_vertices(Tangle& tangle, Watch& watch) {
  watch.enter(UntangleStep::relocate);
  relocate(tangle, watch);
}

bool smooth_vertices(Tangle& tangle, unsigned rings, Watch& watch) {
  watch.enter(UntangleStep::smooth);
  return smooth(tangle, rings, watch);
}

void move_vertices(Tangle& tangle, Watch& watch) {
  if (share_tangled(tangle) > tuning::kMostTangled) smooth_vertices(tangle, tuning::kEverywhere, watch);
  relocate_vertices(tangle, watch);
  const bool many = share_tangled(tangle) > tuning::kManyTangled;
  for (const unsigned rings : tuning::kSmoothedRings)
    if (is_tangled(tangle) && (rings == tuning::kEverywhere || !many) &&
        smooth_vertices(tangle, rings, watch))
      relocate_vertices(tangle, watch);
}

// Each swap may make another one possible, or the move of a vertex. Returns the number of swaps.
std::size_t swap_and_relocate(Tangle& tangle, Watch& watch) {
  std::size_t swapped = 0;
  for (std::size_t swaps = 1; swaps > 0 && is_tangled(tangle);) {
    watch.enter(UntangleStep::swap);
    swaps = swap_tets(tangle, watch);
    swapped += swaps;
    if (swaps > 0) relocate_vertices(tangle, watch);
  }
  return swapped;
}

}  // namespace

UntangleStats make_positive(Tangle& tangle, const CavityFiller* filler, Watch& watch) {
  UntangleStats stats;
  // The connectivity is mostly right for some positions, so it stays unchanged as long as moving helps.
  move_vertices(tangle, watch);
  for (bool gained = true; gained && is_tangled(tangle) && stats.rounds < tuning::kMostUntangleRounds;) {
    const Deficit before = tangle.deficit();
    ++stats.rounds;
    stats.swapped += swap_and_relocate(tangle, watch);
    if (is_tangled(tangle)) move_vertices(tangle, watch);
    gained = tangle.deficit().better_than(before);
  }
  if (is_tangled(tangle) && filler != nullptr) {
    watch.enter(UntangleStep::refill);
    stats.refill = refill(tangle, *filler, watch);
  }
  return stats;
}

}  // namespace holdfast
