#include "suppress/suppress.h"

#include <algorithm>
#include <random>

#include "mesh/traverse.h"
#include "suppress/collapse.h"
#include "suppress/degree.h"
#include "suppress/needed.h"
#include "suppress/refill.h"
#include "suppress/shake.h"
#include "suppress/tuning.h"

namespace holdfast {
namespace {

std::size_t unrounded(const TetMesh& mesh, const std::vector<Vertex>& points) {
  return static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [&](Vertex p) { return !mesh.is_explicit(p); }));
}

class Suppressor {
 public:
  Suppressor(TetMesh& mesh, std::vector<Vertex> points, Vertex first_free, Monitor& monitor,
             std::uint64_t seed)
      : mesh_(mesh),
        points_(std::move(points)),
        first_free_(first_free),
        all_(points_.size()),
        monitor_(monitor),
        random_(seed),
        flipper_(mesh, random_) {}

  SuppressStats run() {
    do shrink();
    while (!points_.empty() && refill());
    shrink();
    insist();
    round_the_rest();
    stats_.left = points_.size();
    stats_.unrounded = unrounded(mesh_, points_);
    return stats_;
  }

 private:
  void tell() {
    monitor_.poll(Stage::suppress, 1.0 - static_cast<double>(points_.size()) / static_cast<double>(all_));
  }

  // Round after round until none removes or rounds a point.
  void shrink() {
    int idle = 0;
    for (int round = 0; round < tuning::kShrinkRounds && idle < tuning::kShrinkIdle && !points_.empty();
         ++round) {
      const std::size_t points_before = points_.size();
      const std::size_t unrounded_before = unrounded(mesh_, points_);
      std::erase_if(points_, [&](Vertex p) {
        tell();
        const Fate fate = remove_or_recentre(mesh_, p, {});
        stats_.collapsed += fate == Fate::collapsed ? 1 : 0;
        stats_.filled += fate == Fate::filled ? 1 : 0;
        return fate == Fate::collapsed || fate == Fate::filled;
      });
      const bool gained = points_.size() < points_before || unrounded(mesh_, points_) < unrounded_before;
      idle = gained ? 0 : idle + 1;
    }
  }

  // Points that no double holds are worth more effort. Returns whether a further go is.
  bool refill() {
    const std::size_t before = points_.size(), unrounded_before = unrounded(mesh_, points_);
    for (const Vertex p : points_) {
      tell();
      if (mesh_.in_mesh(p)) remove_harder(p);
    }
    drop_the_gone(stats_.filled);
    for (const Vertex p : points_)
      if (mesh_.in_mesh(p)) merge_with_neighbours(p);
    drop_the_gone(stats_.merged);
    const std::size_t gone = before - points_.size();
    const std::size_t unrounded_now = unrounded(mesh_, points_);
    return gone * tuning::kWorthwhile > before ||
           (unrounded_now > 0 && (gone > 0 || unrounded_now < unrounded_before));
  }

  // What is left may go from another mesh round it, but for what is proven to stay.
  void insist() {
    // In proportion to the rest of the work, so that it matters where few are left.
    const std::size_t most_shakes =
        std::min(tuning::kMostPointShakes, tuning::kFewShakes + mesh_.tet_count() / tuning::kTetsAShake);
    std::vector<Vertex> spare = points_;
    std::erase_if(spare, [&](Vertex p) { return is_needed(mesh_, p, first_free_); });
    std::size_t shakes = 0;
    int idle = 0;
    for (int round = 0; round < tuning::kInsistRounds && idle < tuning::kInsistIdle && !spare.empty();
         ++round) {
      const std::size_t before = spare.size();
      for (const Vertex p : spare) {
        if (shakes++ == most_shakes) break;
        tell();
        shake(mesh_, flipper_, p, tuning::kShakenEdgesOfPoint, random_);
        lower_degree(mesh_, flipper_, p, Flipper::kDeep, tuning::kShakenBudget);
        remove_or_recentre(mesh_, p, {});
      }
      drop_the_gone(stats_.filled);
      std::erase_if(spare, [&](Vertex p) { return !mesh_.in_mesh(p); });
      if (shakes > most_shakes) return;
      idle = spare.size() < before ? 0 : idle + 1;
    }
  }

  // Nothing but complete searches is left to try, and other meshes round what they do not find.
  void round_the_rest() {
    for (int round = 0; round < tuning::kRoundingRounds; ++round) {
      std::vector<Vertex> rest = points_;
      std::erase_if(rest, [&](Vertex p) { return mesh_.is_explicit(p); });
      if (rest.empty()) return;
      for (const Vertex p : rest) {
        tell();
        if (!mesh_.in_mesh(p) || round_completely(mesh_, p, first_free_, tuning::kMostSteps, tell_)) continue;
        if (round_at_random(p)) continue;
        shake(mesh_, flipper_, p, tuning::kShakenEdgesOfPoint, random_);
        remove_or_recentre(mesh_, p, {});
      }
      drop_the_gone(stats_.filled);
    }
  }

  bool round_at_random(Vertex p) {
    for (int k = 0; k < tuning::kRandomTries; ++k)
      if (round_completely(mesh_, p, first_free_, tuning::kMostRandomSteps, tell_, random_)) return true;
    return false;
  }

  void drop_the_gone(std::size_t& count) {
    count += std::erase_if(points_, [&](Vertex p) { return !mesh_.in_mesh(p); });
  }

  void remove_harder(Vertex p) {
    const bool is_explicit = mesh_.is_explicit(p);
    if (lower_degree(mesh_, flipper_, p, Flipper::kDeep,
                     is_explicit ? tuning::kQuickBudget : tuning::kPatientBudget)) {
      const Fate fate = remove_or_recentre(mesh_, p, {});
      if (fate == Fate::collapsed || fate == Fate::filled) return;
    }
    const Growth& growth = is_explicit ? tuning::kQuickGrowth : tuning::kPatientGrowth;
    if (refill_without(mesh_, p, first_free_, growth, random_)) return;
    if (!mesh_.is_explicit(p)) round_with_neighbours(mesh_, p, first_free_, tuning::kMostSteps);
  }

  void merge_with_neighbours(Vertex p) {
    for (const Vertex q : link_vertices(mesh_, p))
      if (q >= first_free_ && mesh_.in_mesh(p) && find_edge(mesh_, p, q) != kNone)
        merge(mesh_, p, q, first_free_, tuning::kMergeSteps, tuning::kMergeSearch);
  }

  TetMesh& mesh_;
  std::vector<Vertex> points_;
  const Vertex first_free_;
  const std::size_t all_;
  Monitor& monitor_;
  std::mt19937_64 random_;
  Flipper flipper_;
  const Tell tell_ = [this] { tell(); };
  SuppressStats stats_;
};

}  // namespace

SuppressStats suppress(TetMesh& mesh, std::vector<Vertex> points, Vertex first_free, Monitor& monitor,
                       std::uint64_t seed) {
  return Suppressor(mesh, std::move(points), first_free, monitor, seed).run();
}

}  // namespace holdfast
