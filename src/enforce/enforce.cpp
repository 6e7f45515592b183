// Recovers all segments, then all facets, each group in random order unless the options give another. The
// points of one constraint are eliminated before the next one is partitioned; otherwise points lead to more
// points (paper §2.4). A missing segment has no facet yet, so its points are eliminated as those of a
// dangling segment, whatever its final degree. After that, every missing facet has three single edges as
// sides.
#include "enforce/enforce.h"

#include <functional>
#include <random>
#include <utility>

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

std::vector<Index> missing_in_order(LayingOrder order, const std::vector<std::uint8_t>& stands,
                                    Random& random) {
  std::vector<Index> missing;
  for (Index k = 0; k < stands.size(); ++k)
    if (stands[k] == 0) missing.push_back(k);
  if (order == LayingOrder::random) numbers::shuffle(missing.begin(), missing.end(), random);
  return order == LayingOrder::halving ? numbers::halved(missing) : missing;
}

class Enforcement {
 public:
  Enforcement(TetMesh& mesh, const ConstraintSet& constraints, Vertex first_free,
              const EnforceOptions& options, Monitor& monitor)
      : mesh_(mesh),
        facets_(constraints.facets),
        standing_(constraints.standing),
        options_(options),
        monitor_(monitor),
        random_(options.seed),
        tell_([this] { tell(); }),
        steiner_(mesh, first_free, random_),
        flips_(mesh, constraints, options.seed),
        cavities_(mesh, options.seed),
        partition_(mesh, constraints.table, constraints.facets, first_free, random_, tell_) {}

  EnforceStats run() {
    const std::vector<Index> segments = missing_in_order(options_.order, standing_.segments, random_);
    const std::vector<Index> facets = missing_in_order(options_.order, standing_.facets, random_);
    missing_ = segments.size() + facets.size();
    recover_all(segments, ways_for_segments());
    recover_all(facets, ways_for_facets());
    stats_.pieces = partition_.take_pieces();
    return std::move(stats_);
  }

 private:
  // A way to recover a missing constraint; returns whether the constraint now stands.
  using Way = bool (Enforcement::*)(Index);

  // In the order in which they are tried; the last one never fails.
  [[nodiscard]] std::vector<Way> ways_for_segments() const {
    if (!tries_flips()) return {&Enforcement::segment_by_partition};
    return {&Enforcement::segment_by_flips, &Enforcement::segment_by_partition};
  }

  [[nodiscard]] std::vector<Way> ways_for_facets() const {
    if (!tries_flips()) return {&Enforcement::facet_by_partition};
    if (!options_.cavities) return {&Enforcement::facet_by_flips, &Enforcement::facet_by_partition};
    return {&Enforcement::facet_by_few_flips, &Enforcement::facet_by_cavities,
            &Enforcement::facet_by_partition};
  }

  [[nodiscard]] bool tries_flips() const { return options_.flips && options_.eliminate; }

  void recover_all(const std::vector<Index>& missing, const std::vector<Way>& ways) {
    for (const Index k : missing) {
      tell();
      for (const Way way : ways)
        if ((this->*way)(k)) break;
      ++recovered_;
    }
  }

  bool segment_by_flips(Index s) { return flips_.segment(s, tuning::kRetry); }
  bool facet_by_flips(Index f) { return flips_.facet(f, tuning::kRetry); }

  // Cavities need no point for each edge that pierces the facet. The fewer edges pierce it, the less flips
  // cost.
  bool facet_by_few_flips(Index f) {
    return cavities_.crossing(facets_[f]) < tuning::kManyCrossing && facet_by_flips(f);
  }

  bool facet_by_cavities(Index f) {
    const auto finish = [this](TetMesh& cavity, const ConstraintSet& its_constraints, Vertex its_first_free) {
      finish_cavity(cavity, its_constraints, its_first_free);
    };
    if (!recover_by_cavities(mesh_, cavities_, facets_[f], steiner_, tell_, finish)) return false;
    standing_.facets[f] = 1;
    return true;
  }

  void finish_cavity(TetMesh& cavity, const ConstraintSet& constraints, Vertex first_free) {
    const EnforceStats inside =
        enforce(cavity, constraints, first_free, {.seed = random_(), .cavities = false}, monitor_);
    stats_.segment_points += inside.segment_points;
    stats_.facet_points += inside.facet_points;
  }

  bool segment_by_partition(Index s) {
    stats_.segment_points += partition_.cut_segment(s);
    if (options_.eliminate) partition_.eliminate_from_segment(s, steiner_);
    standing_.segments[s] = 1;
    return true;
  }

  bool facet_by_partition(Index f) {
    stats_.facet_points += partition_.cut_facet(f);
    if (options_.eliminate) partition_.eliminate_from_facet(steiner_);
    standing_.facets[f] = 1;
    return true;
  }

  void tell() {
    monitor_.poll(options_.eliminate ? Stage::eliminate : Stage::partition,
                  static_cast<double>(recovered_) / static_cast<double>(missing_));
  }

  TetMesh& mesh_;
  const std::span<const Triangle> facets_;
  Standing& standing_;
  const EnforceOptions& options_;
  Monitor& monitor_;
  Random random_;
  const std::function<void()> tell_;
  SteinerPoints steiner_;
  FlipRecovery flips_;
  FacetCavities cavities_;
  Partition partition_;
  std::size_t missing_ = 0, recovered_ = 0;  // constraints: at first, and so far
  EnforceStats stats_;
};

}  // namespace

EnforceStats enforce(TetMesh& mesh, const ConstraintSet& constraints, Vertex first_free,
                     const EnforceOptions& options, Monitor& monitor) {
  return Enforcement(mesh, constraints, first_free, options, monitor).run();
}

}  // namespace holdfast
