#include "untangle/untangle.h"

#include "untangle/relocate.h"
#include "untangle/smooth.h"
#include "untangle/swap.h"

namespace holdfast {
namespace {

class Rounds {
 public:
  Rounds(Tangle& tangle, Watch& watch, UntangleStats& stats) : tangle_(tangle), watch_(watch), stats_(stats) {}

  void run() {
    constexpr unsigned kFewestRings = 2, kMostRings = 1024;
    for (unsigned rings = kFewestRings; tangled() && rings <= kMostRings;) {
      const Deficit before = tangle_.deficit();
      ++stats_.rounds;
      relocate_and_swap();
      if (!tangled()) return;
      watch_.enter(UntangleStep::smooth);
      smooth(tangle_, rings, watch_);
      // What did not help near by may help from farther.
      if (!tangle_.deficit().better_than(before)) rings *= 4;
    }
  }

 private:
  [[nodiscard]] bool tangled() const { return tangle_.nonpositive_count() > 0; }

  void relocate_and_swap() {
    for (bool changed = true; changed && tangled();) {
      watch_.enter(UntangleStep::relocate);
      relocate(tangle_, watch_);
      if (!tangled()) return;
      watch_.enter(UntangleStep::swap);
      const std::size_t swaps = swap(tangle_, watch_);
      stats_.swapped += swaps;
      changed = swaps > 0;
    }
  }

  Tangle& tangle_;
  Watch& watch_;
  UntangleStats& stats_;
};

}  // namespace

UntangleStats untangle(Tangle& tangle, const Filler* filler, Watch& watch) {
  UntangleStats stats;
  Rounds(tangle, watch, stats).run();
  if (tangle.nonpositive_count() > 0 && filler != nullptr) {
    watch.enter(UntangleStep::refill);
    stats.refill = refill(tangle, *filler, watch);
  }
  return stats;
}

}  // namespace holdfast
