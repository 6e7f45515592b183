#include "untangle/make_positive.h"

#include <array>

#include "untangle/relocate.h"
#include "untangle/smooth.h"
#include "untangle/swap.h"

namespace holdfast {
namespace {

constexpr unsigned kEverywhere = 1u << 20;
constexpr std::array<unsigned, 3> kRings{3, 12, kEverywhere};
// Shares of the tetrahedra, above which smoothing near by is time lost, and moving vertices one by one is
// too.
constexpr double kMany = 0.02, kMost = 0.1;

class Rounds {
 public:
  Rounds(Tangle& tangle, Watch& watch, UntangleStats& stats)
      : tangle_(tangle), watch_(watch), stats_(stats) {}

  // The connectivity is right for some positions, most often: as long as moving helps it stays as it is.
  void run() {
    move_vertices();
    bool gained = true;
    for (int round = 0; gained && tangled() && round < kMostRounds; ++round) {
      const Deficit before = tangle_.deficit();
      ++stats_.rounds;
      swap_all();
      if (tangled()) move_vertices();
      gained = tangle_.deficit().better_than(before);
    }
  }

 private:
  static constexpr int kMostRounds = 10;

  [[nodiscard]] bool tangled() const { return tangle_.nonpositive_count() > 0; }

  void move_vertices() {
    if (share() > kMost) smooth_vertices(kEverywhere);
    relocate_vertices();
    const bool many = share() > kMany;
    for (const unsigned rings : kRings)
      if (tangled() && (rings == kEverywhere || !many) && smooth_vertices(rings)) relocate_vertices();
  }

  // Of the tetrahedra, those that are not positive.
  [[nodiscard]] double share() const {
    return static_cast<double>(tangle_.nonpositive_count()) / static_cast<double>(tangle_.tet_count());
  }

  bool smooth_vertices(unsigned rings) {
    watch_.enter(UntangleStep::smooth);
    return smooth(tangle_, rings, watch_);
  }

  void relocate_vertices() {
    watch_.enter(UntangleStep::relocate);
    relocate(tangle_, watch_);
  }

  // Each swap may open another's way, and a vertex's.
  void swap_all() {
    for (std::size_t swaps = 1; swaps > 0 && tangled();) {
      watch_.enter(UntangleStep::swap);
      swaps = swap_tets(tangle_, watch_);
      stats_.swapped += swaps;
      if (swaps > 0) relocate_vertices();
    }
  }

  Tangle& tangle_;
  Watch& watch_;
  UntangleStats& stats_;
};

}  // namespace

UntangleStats make_positive(Tangle& tangle, const Filler* filler, Watch& watch) {
  UntangleStats stats;
  Rounds(tangle, watch, stats).run();
  if (tangle.nonpositive_count() > 0 && filler != nullptr) {
    watch.enter(UntangleStep::refill);
    stats.refill = refill(tangle, *filler, watch);
  }
  return stats;
}

}  // namespace holdfast
