#include "recover/recover.h"

#include <algorithm>
#include <vector>

#include "mesh/traverse.h"
#include "recover/flipper.h"
#include "recover/pierce.h"

namespace holdfast {
namespace {

// Levels of flips that clear the way for others, and the work (roughly sign tests) an entity gets there.
struct Effort {
  int depth;
  std::size_t budget;
};
constexpr std::array<Effort, 9> kEfforts{{{0, 20'000}, {1, 20'000}, {2, 40'000}, {3, 40'000}, {4, 80'000}, {6, 80'000}, {8, 100'000}, {10, 100'000}, {14, 100'000}}};
constexpr std::size_t kMostCrossings = 2000;

class Rounds {
 public:
  bool go_on() {
    if (first_) return !(first_ = false);
    if (fell_) { loose_ = 0; }
    else if (loose_ > 0 && !moved_) return false;
    else ++loose_;
    fell_ = moved_ = false;
    return loose_ <= kMostLoose;
  }
  int most_change() const { return loose_ > 0 ? 0 : -1; }
  void note(int change) { moved_ = true; fell_ |= change < 0; }
 private:
  static constexpr int kMostLoose = 8;
  bool first_ = true, fell_ = false, moved_ = false;
  int loose_ = 0;
};

class Recovery {
 public:
  Recovery(TetMesh& mesh, const SegmentTable& table, std::span<const Triangle> facets, Standing& standing,
           std::uint64_t seed, Monitor& monitor)
      : mesh_(mesh),
        table_(table),
        facets_(facets),
        standing_(standing),
        random_(seed),
        monitor_(monitor),
        piercing_(mesh, random_),
        flipper_(mesh, random_) {}

  FlipStats run() {
    FlipStats stats;
    stats.missing_segments = standing_.missing_segments();
    stats.missing_facets = standing_.missing_facets();
    pass_over(standing_.segments, [&](Index s, const Effort& e) { return recover_segment(s, e); });
    pass_over(standing_.facets, [&](Index f, const Effort& e) { return recover_facet(f, e); });
    stats.recovered_segments = stats.missing_segments - standing_.missing_segments();
    stats.recovered_facets = stats.missing_facets - standing_.missing_facets();
    stats.face_flips = flipper_.counts().face_flips;
    stats.edge_removals = flipper_.counts().edge_removals;
    stats.undone = flipper_.counts().undone;
    return stats;
  }

 private:
  template <typename RecoverOne>
  void pass_over(std::vector<std::uint8_t>& stands, RecoverOne recover_one) {
    std::vector<Index> missing;
    for (Index k = 0; k < stands.size(); ++k)
      if (stands[k] == 0) missing.push_back(k);
    std::size_t pass = 0;
    for (const Effort& effort : kEfforts) {
      std::shuffle(missing.begin(), missing.end(), random_);
      std::size_t done = 0;
      for (const Index k : missing) {
        monitor_.poll(Stage::flips, (static_cast<double>(pass) +
                                     static_cast<double>(done++) / static_cast<double>(missing.size())) /
                                        static_cast<double>(kEfforts.size()));
        if (stands[k] == 0 && recover_one(k, effort)) stands[k] = 1;
      }
      std::erase_if(missing, [&](Index k) { return stands[k] != 0; });
      if (missing.empty()) return;
      ++pass;
    }
  }

  bool recover_segment(Index s, const Effort& effort) {
    const auto [a, b] = table_.segments[s];
    flipper_.aim(Target::segment(a, b), effort.budget);
    Rounds rounds;
    while (!flipper_.exhausted() && rounds.go_on()) {
      crossings_.clear();
      if (!piercing_.by_segment(a, b, crossings_, kMostCrossings)) return false;
      if (crossings_.empty()) {
        set_segment(mesh_, piercing_.find_edge(a, b), a, b);
        return true;
      }
      std::shuffle(crossings_.begin(), crossings_.end(), random_);
      for (const Crossing& c : crossings_)
        if (!flipper_.exhausted() && flipper_.clear(c, effort.depth, rounds.most_change()))
          rounds.note(flipper_.last_change());
    }
    return false;
  }

  bool recover_facet(Index f, const Effort& effort) {
    for (const Index s : table_.facet_segments[f])
      if (standing_.segments[s] == 0) return false;
    flipper_.aim(Target::facet(facets_[f]), effort.budget);
    Rounds rounds;
    while (!flipper_.exhausted() && rounds.go_on()) {
      edges_.clear();
      if (!piercing_.of_facet(facets_[f], edges_, kMostCrossings)) return false;
      if (edges_.empty()) {
        const Face face = piercing_.find_face(facets_[f][0], facets_[f][1], facets_[f][2]);
        if (face == kNone) return false;
        mesh_.set_facet(face);
        return true;
      }
      std::shuffle(edges_.begin(), edges_.end(), random_);
      for (const PiercingEdge& e : edges_)
        if (!flipper_.exhausted() &&
            flipper_.clear({e.tet, {e.above, e.below}, 2}, effort.depth, rounds.most_change()))
          rounds.note(flipper_.last_change());
    }
    return false;
  }

  TetMesh& mesh_;
  const SegmentTable& table_;
  std::span<const Triangle> facets_;
  Standing& standing_;
  Random random_;
  Monitor& monitor_;
  Piercing piercing_;
  Flipper flipper_;
  std::vector<Crossing> crossings_;
  std::vector<PiercingEdge> edges_;
};

}  // namespace

FlipStats recover_by_flips(TetMesh& mesh, const SegmentTable& table, std::span<const Triangle> facets,
                           Standing& standing, std::uint64_t seed, Monitor& monitor) {
  return Recovery(mesh, table, facets, standing, seed, monitor).run();
}

}  // namespace holdfast
