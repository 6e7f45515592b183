#include "enforce/enforce.h"

#include <algorithm>
#include <random>
#include <unordered_set>

#include "enforce/collapse_within.h"
#include "enforce/cut_and_cone.h"
#include "enforce/partition_facet.h"
#include "enforce/partition_segment.h"
#include "mesh/editor.h"
#include "mesh/kernel.h"
#include "mesh/traverse.h"
#include "numbers/random.h"
#include "numbers/sorted.h"
#include "recover/facet_cavities.h"
#include "recover/recover.h"
#include "suppress/collapse.h"
#include "suppress/degree.h"

namespace holdfast {
namespace {

class Enforcer {
 public:
  Enforcer(TetMesh& mesh, const SegmentTable& table, std::span<const Triangle> facets, Standing& standing,
           Vertex first_free, const EnforceOptions& options, Monitor& monitor)
      : mesh_(mesh),
        table_(table),
        facets_(facets),
        standing_(standing),
        first_free_(first_free),
        random_(options.seed),
        flipper_(mesh, random_),
        monitor_(monitor),
        eliminate_(options.eliminate),
        retry_(options.flips && options.eliminate),
        by_cavities_(retry_ && options.cavities),
        flips_(mesh, table, facets, standing, options.seed),
        cavities_(mesh, options.seed),
        chains_(table.segments.size()) {
    for (Index s = 0; s < table.segments.size(); ++s)
      if (standing.segments[s] == 0) missing_segments_.push_back(s);
    for (Index f = 0; f < facets.size(); ++f)
      if (standing.facets[f] == 0) missing_facets_.push_back(f);
    numbers::shuffle(missing_segments_.begin(), missing_segments_.end(), random_);
    numbers::shuffle(missing_facets_.begin(), missing_facets_.end(), random_);
  }

  // All segments, then all facets, each group in random order, and the points of one are eliminated before
  // the next is laid: else points beget points (paper §2.4). A missing segment has no facet yet, so that
  // its points are eliminated as those of a dangling one, whatever its degree in the end; then every
  // missing facet has three single edges for sides.
  EnforceStats run() {
    for (const Index s : missing_segments_) {
      tell();
      if (!retry_ || !flips_.segment(s, kRetry)) lay_segment(s);
    }
    for (const Index f : missing_facets_) {
      tell();
      if (!recover_again(f)) lay_facet(f);
    }
    return stats_;
  }

 private:
  void tell() {
    const auto all = static_cast<double>(missing_segments_.size() + missing_facets_.size());
    monitor_.poll(eliminate_ ? Stage::eliminate : Stage::partition, static_cast<double>(laid_) / all);
  }

  // Without a point for each edge that pierces the facet. Flips cost the less the fewer edges there are.
  bool recover_again(Index f) {
    constexpr std::size_t kMany = 300;
    if (!by_cavities_) return retry_ && flips_.facet(f, kRetry);
    if (cavities_.crossing(facets_[f]) < kMany && flips_.facet(f, kRetry)) return true;
    return recover_by_cavities(f);
  }

  bool recover_by_cavities(Index f) {
    const auto finish = [&](TetMesh& mesh, const SegmentTable& table, std::span<const Triangle> facets,
                            Standing& standing, Vertex first_free) {
      const EnforceStats inside = enforce(mesh, table, facets, standing, first_free,
                                          {.seed = random_(), .cavities = false}, monitor_);
      stats_.segment_points += inside.segment_points;
      stats_.facet_points += inside.facet_points;
    };
    const auto recover = [&] {
      return cavities_.recover(
          facets_[f], [&] { tell(); }, finish);
    };
    constexpr int kTries = 3;
    for (int tries = 0; !recover(); ++tries)
      if (tries == kTries || !clear_plane(facets_[f], tries == 0)) return false;
    standing_.facets[f] = 1;
    const std::vector<Vertex>& fresh = cavities_.added();
    restless_.insert(restless_.end(), fresh.begin(), fresh.end());
    steiner_.insert(steiner_.end(), fresh.begin(), fresh.end());
    settle();
    settle_all();
    return true;
  }

  // Steiner points in the facet, for which the cavities gave up, may go if that is to be tried; the others
  // move a little. Returns whether there were any.
  bool clear_plane(const Triangle& facet, bool may_go) {
    std::vector<Vertex> in_the_way = cavities_.in_the_way();
    std::erase_if(in_the_way, [&](Vertex v) { return v < first_free_; });
    if (may_go) {
      restless_ = in_the_way;
      settle();
    }
    for (const Vertex v : in_the_way)
      if (mesh_.in_mesh(v)) leave_plane(v, facet);
    return !in_the_way.empty();
  }

  // The part of v's kernel above the facet is not empty: v lies in its closure, and in no other of its
  // planes.
  void leave_plane(Vertex v, const Triangle& facet) {
    if (mesh_.orient(facet[0], facet[1], facet[2], v) != 0) return;
    std::vector<Tet> tets;
    ball(mesh_, v, tets);
    Kernel above = kernel_of_ball(mesh_, v, tets);
    above.add(facet[0], facet[1], facet[2]);
    if (const std::optional<Position> place = above.find(mesh_.point(v)))
      MeshEditor(mesh_).move_vertex(v, *place);
  }

  void lay_facet(Index f) {
    std::vector<Vertex> inner = partition_facet(mesh_, frame_of(f), stats_.facet_points);
    standing_.facets[f] = 1;
    ++laid_;
    if (!eliminate_) return;
    numbers::shuffle(inner.begin(), inner.end(), random_);
    for (const Vertex p : inner) {
      tell();
      eliminate(p, std::nullopt);
    }
    settle();
    settle_all();
  }

  void lay_segment(Index s) {
    const auto [a, b] = table_.segments[s];
    chains_[s] = partition_segment(mesh_, a, b, first_free_);
    stats_.segment_points += chains_[s].size() - 2;
    ++laid_;
    if (eliminate_) eliminate_chain(s);
  }

  [[nodiscard]] FacetFrame frame_of(Index f) const {
    FacetFrame frame{{facets_[f][0], facets_[f][1], facets_[f][2]}, {}};
    for (std::size_t i = 0; i < 3; ++i) {
      const Index s = table_.facet_segments[f][i];
      const Vertex from = facets_[f][(i + 1) % 3];
      frame.sides[i] =
          chains_[s].empty() ? std::vector<Vertex>{table_.segments[s][0], table_.segments[s][1]} : chains_[s];
      if (frame.sides[i].front() != from) std::reverse(frame.sides[i].begin(), frame.sides[i].end());
    }
    return frame;
  }

  // In random order: in sequence the kernels decay geometrically (docs/concepts.md).
  void eliminate_chain(Index s) {
    std::vector<Vertex>& chain = chains_[s];
    std::vector<Vertex> points(chain.begin() + 1, chain.end() - 1);
    on_chain_.insert(points.begin(), points.end());
    numbers::shuffle(points.begin(), points.end(), random_);
    constexpr std::size_t kSettleEvery = 4;
    for (std::size_t k = 0; k < points.size(); ++k) {
      tell();
      const auto it = std::find(chain.begin(), chain.end(), points[k]);
      eliminate(points[k], std::array<Vertex, 2>{*(it - 1), *(it + 1)});
      on_chain_.erase(points[k]);
      chain.erase(it);
      if ((k + 1) % kSettleEvery == 0) settle();
    }
    settle();
    settle_all();
    chain.clear();
    standing_.segments[s] = 1;
  }

  // Along its own constraint where that can be had: then no point is added at all.
  void eliminate(Vertex p, std::optional<std::array<Vertex, 2>> ends) {
    const bool gone = ends ? collapse_within(mesh_, p, *ends, std::span(&*ends, 1))
                           : collapse_within(mesh_, p, facet_neighbours(mesh_, p), {});
    if (gone) return;
    const std::vector<Vertex> fresh = cut_and_cone(mesh_, p, ends);
    restless_.insert(restless_.end(), fresh.begin(), fresh.end());
    steiner_.insert(steiner_.end(), fresh.begin(), fresh.end());
  }

  // All Steiner points now and then, whenever their number has doubled: a later facet pierces each edge
  // that they keep, so that points beget points (paper §2.4).
  void settle_all() {
    std::erase_if(steiner_, [&](Vertex p) { return !mesh_.in_mesh(p); });
    constexpr std::size_t kSlack = 64;
    if (2 * steiner_.size() < 3 * settled_ + kSlack) return;
    restless_ = steiner_;
    std::erase_if(restless_, [&](Vertex p) { return on_chain_.contains(p); });
    settle(kThoroughSearch);
    std::erase_if(steiner_, [&](Vertex p) { return !mesh_.in_mesh(p); });
    settled_ = steiner_.size();
  }

  // Suppresses or recentres the Steiner points that were just made, and those next to a suppressed one.
  void settle(const PolyhedronOptions& search = kQuickSearch) {
    for (int round = 0; round < kRounds && !restless_.empty(); ++round) {
      std::vector<Vertex> now;
      now.swap(restless_);
      sort_unique(now);
      for (const Vertex p : now) {
        if (!mesh_.in_mesh(p)) continue;
        const std::vector<Vertex> around = steiner_neighbours(p);
        lower_degree(mesh_, flipper_, p, kFlipDepth, kFlipBudget);
        const Fate fate = remove_or_recentre(mesh_, p, search);
        if (fate == Fate::collapsed || fate == Fate::filled)
          restless_.insert(restless_.end(), around.begin(), around.end());
        else if (fate == Fate::moved && round + 1 < kRounds)
          restless_.push_back(p);
      }
    }
    restless_.clear();
  }

  // Steiner points in the link of p that lie on no constraint (no facet has inner points when this is asked).
  std::vector<Vertex> steiner_neighbours(Vertex p) {
    std::vector<Vertex> out = link_vertices(mesh_, p);
    std::erase_if(out, [&](Vertex v) { return v < first_free_ || on_chain_.contains(v); });
    return out;
  }

  static constexpr FlipRecovery::Effort kRetry{.depth = Flipper::kDeep, .budget = 2000, .thorough = true};
  static constexpr int kRounds = 2;
  static constexpr int kFlipDepth = 8;
  static constexpr std::size_t kFlipBudget = 200;
  static constexpr PolyhedronOptions kThoroughSearch{.most_vertices = 18, .most_nodes = 200};
  static constexpr PolyhedronOptions kQuickSearch{.most_vertices = 13, .most_nodes = 40};

  TetMesh& mesh_;
  const SegmentTable& table_;
  std::span<const Triangle> facets_;
  Standing& standing_;
  const Vertex first_free_;
  std::mt19937_64 random_;
  Flipper flipper_;
  Monitor& monitor_;
  const bool eliminate_, retry_, by_cavities_;
  FlipRecovery flips_;
  FacetCavities cavities_;
  std::vector<std::vector<Vertex>> chains_;  // by segment; empty where it is one edge
  std::unordered_set<Vertex> on_chain_;
  std::vector<Index> missing_segments_, missing_facets_;
  std::size_t laid_ = 0;
  std::vector<Vertex> restless_;  // Steiner points to be settled
  std::vector<Vertex> steiner_;   // Steiner points that there are, and some that are gone
  std::size_t settled_ = 0;       // how many there were when all were last settled
  EnforceStats stats_;
};

}  // namespace

EnforceStats enforce(TetMesh& mesh, const SegmentTable& table, std::span<const Triangle> facets,
                     Standing& standing, Vertex first_free, const EnforceOptions& options, Monitor& monitor) {
  return Enforcer(mesh, table, facets, standing, first_free, options, monitor).run();
}

}  // namespace holdfast
