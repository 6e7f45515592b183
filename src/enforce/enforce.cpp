#include "enforce/enforce.h"

#include <algorithm>
#include <deque>
#include <random>
#include <unordered_set>

#include "enforce/collapse_within.h"
#include "enforce/cut_and_cone.h"
#include "enforce/partition_facet.h"
#include "enforce/partition_segment.h"
#include "mesh/traverse.h"
#include "suppress/collapse.h"

namespace holdfast {
namespace {

class Enforcer {
 public:
  Enforcer(TetMesh& mesh, const SegmentTable& table, std::span<const Triangle> facets, Standing& standing,
           Vertex first_free, std::uint64_t seed, Monitor& monitor, bool eliminate)
      : mesh_(mesh),
        table_(table),
        facets_(facets),
        standing_(standing),
        first_free_(first_free),
        random_(seed),
        monitor_(monitor),
        eliminate_(eliminate),
        chains_(table.segments.size()),
        pending_(table.segments.size(), 0) {
    for (Index f = 0; f < facets.size(); ++f) {
      if (standing.facets[f] != 0) continue;
      missing_.push_back(f);
      for (const Index s : table.facet_segments[f]) ++pending_[s];
    }
  }

  EnforceStats run() {
    lay_facets();
    for (Index s = 0; s < chains_.size(); ++s)
      if (standing_.segments[s] == 0 && pending_[s] == 0 && table_.facets_of(s).empty())
        lay_dangling_segment(s);
    return stats_;
  }

 private:
  // Random seeds (paper §2.4), then from neighbour to neighbour: a segment's points can go as soon as all
  // its facets are laid, so that few points stand at a time.
  void lay_facets() {
    std::shuffle(missing_.begin(), missing_.end(), random_);
    std::deque<Index> front;
    std::size_t next = 0;
    while (laid_ < missing_.size()) {
      if (front.empty()) {
        while (standing_.facets[missing_[next]] != 0) ++next;
        front.push_back(missing_[next]);
      }
      const Index f = front.front();
      front.pop_front();
      if (standing_.facets[f] != 0) continue;
      lay_facet(f);
      for (const Index s : table_.facet_segments[f])
        for (const Index g : table_.facets_of(s))
          if (standing_.facets[g] == 0) front.push_back(g);
    }
  }

  void lay_facet(Index f) {
    monitor_.poll(Stage::partition, static_cast<double>(laid_) / static_cast<double>(missing_.size()));
    for (const Index s : table_.facet_segments[f])
      if (standing_.segments[s] == 0 && chains_[s].empty()) lay_chain(s);
    std::vector<Vertex> inner = partition_facet(mesh_, frame_of(f), stats_.facet_points);
    standing_.facets[f] = 1;
    ++laid_;
    if (!eliminate_) return;
    std::shuffle(inner.begin(), inner.end(), random_);
    for (const Vertex p : inner) {
      monitor_.poll(Stage::eliminate, static_cast<double>(laid_) / static_cast<double>(missing_.size()));
      eliminate(p, std::nullopt);
    }
    settle();
    settle_all();
    for (const Index s : table_.facet_segments[f])
      if (--pending_[s] == 0 && !chains_[s].empty()) eliminate_chain(s);
  }

  void lay_chain(Index s) {
    const auto [a, b] = table_.segments[s];
    chains_[s] = partition_segment(mesh_, a, b, first_free_);
    stats_.segment_points += chains_[s].size() - 2;
    on_chain_.insert(chains_[s].begin() + 1, chains_[s].end() - 1);
  }

  void lay_dangling_segment(Index s) {
    lay_chain(s);
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

  // In random order: in sequence the kernels decay geometrically (design §2.5).
  void eliminate_chain(Index s) {
    std::vector<Vertex>& chain = chains_[s];
    std::vector<Vertex> points(chain.begin() + 1, chain.end() - 1);
    std::shuffle(points.begin(), points.end(), random_);
    constexpr std::size_t kSettleEvery = 4;
    for (std::size_t k = 0; k < points.size(); ++k) {
      monitor_.poll(Stage::eliminate, static_cast<double>(laid_) / static_cast<double>(missing_.size()));
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
    const std::vector<Vertex> fresh = cut_and_cone(mesh_, p, ends, random_);
    restless_.insert(restless_.end(), fresh.begin(), fresh.end());
    steiner_.insert(steiner_.end(), fresh.begin(), fresh.end());
  }

  // All Steiner points now and then, whenever their number has doubled: a later facet pierces each edge
  // that they keep, so that points beget points (paper §2.4).
  void settle_all() {
    std::erase_if(steiner_, [&](Vertex p) { return !mesh_.in_mesh(p); });
    constexpr std::size_t kSlack = 64;
    if (steiner_.size() < 2 * settled_ + kSlack) return;
    restless_ = steiner_;
    std::erase_if(restless_, [&](Vertex p) { return on_chain_.contains(p); });
    settle();
    std::erase_if(steiner_, [&](Vertex p) { return !mesh_.in_mesh(p); });
    settled_ = steiner_.size();
  }

  // Suppresses or recentres the Steiner points that were just made, and those next to a suppressed one.
  void settle() {
    for (int round = 0; round < kRounds && !restless_.empty(); ++round) {
      std::vector<Vertex> now;
      now.swap(restless_);
      std::sort(now.begin(), now.end());
      now.erase(std::unique(now.begin(), now.end()), now.end());
      for (const Vertex p : now) {
        if (!mesh_.in_mesh(p)) continue;
        const std::vector<Vertex> around = steiner_neighbours(p);
        const Fate fate = remove_or_recentre(mesh_, p);
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
    std::vector<Tet> tets;
    ball(mesh_, p, tets);
    std::vector<Vertex> out;
    for (const Tet t : tets)
      for (const Vertex v : mesh_.corners(t))
        if (v >= first_free_ && v != p && v != kGhost && !on_chain_.contains(v)) out.push_back(v);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

  static constexpr int kRounds = 3;

  TetMesh& mesh_;
  const SegmentTable& table_;
  std::span<const Triangle> facets_;
  Standing& standing_;
  const Vertex first_free_;
  std::mt19937_64 random_;
  Monitor& monitor_;
  const bool eliminate_;
  std::vector<std::vector<Vertex>> chains_;  // by segment; empty where it is one edge
  std::unordered_set<Vertex> on_chain_;
  std::vector<Index> pending_;  // by segment: facets round it that are not laid yet
  std::vector<Index> missing_;
  std::size_t laid_ = 0;
  std::vector<Vertex> restless_;  // Steiner points to be settled
  std::vector<Vertex> steiner_;   // Steiner points that there are, and some that are gone
  std::size_t settled_ = 0;       // how many there were when all were last settled
  EnforceStats stats_;
};

}  // namespace

EnforceStats enforce(TetMesh& mesh, const SegmentTable& table, std::span<const Triangle> facets,
                     Standing& standing, Vertex first_free, std::uint64_t seed, Monitor& monitor,
                     bool eliminate) {
  return Enforcer(mesh, table, facets, standing, first_free, seed, monitor, eliminate).run();
}

}  // namespace holdfast
