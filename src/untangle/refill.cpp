#include "untangle/refill.h"

#include <algorithm>

#include "untangle/refill_cavity.h"

namespace holdfast {
namespace {

// A set of tetrahedra that grows by those that share a vertex with it.
class Growing {
 public:
  explicit Growing(const Tangle& tangle) : tangle_(tangle), taken_(tangle.slot_count(), false) {}

  void add(Tet t) {
    if (taken_[t]) return;
    taken_[t] = true;
    tets_.push_back(t);
  }
  /// Returns false where there is nothing left to add.
  bool grow() {
    const std::size_t end = tets_.size();
    for (std::size_t k = grown_; k < end; ++k)
      for (const Vertex v : tangle_.corners(tets_[k]))
        for (const Tet s : tangle_.star(v)) add(s);
    grown_ = end;
    return tets_.size() > end;
  }
  [[nodiscard]] const std::vector<Tet>& tets() const { return tets_; }

 private:
  const Tangle& tangle_;
  std::vector<bool> taken_;
  std::vector<Tet> tets_;
  std::size_t grown_ = 0;
};

// Non-positive tetrahedra that hang together by vertices.
void add_cluster(const Tangle& tangle, Tet seed, Growing& cavity) {
  std::vector<Tet> queue{seed};
  std::vector<bool> seen(tangle.slot_count(), false);
  seen[seed] = true;
  for (std::size_t k = 0; k < queue.size(); ++k) {
    cavity.add(queue[k]);
    for (const Vertex v : tangle.corners(queue[k]))
      for (const Tet s : tangle.star(v))
        if (tangle.sign(s) <= 0 && !seen[s]) {
          seen[s] = true;
          queue.push_back(s);
        }
  }
}

}  // namespace

RefillStats refill(Tangle& tangle, const Filler& filler, Watch& watch) {
  RefillStats stats;
  while (tangle.nonpositive_count() > 0) {
    Growing growing(tangle);
    add_cluster(tangle, tangle.nonpositive().front(), growing);
    auto outcome = RefillCavity::Outcome::invalid;
    bool whole = false;
    for (int layers = 1; outcome != RefillCavity::Outcome::filled && !whole; layers *= 2) {
      for (int k = 0; k < (layers + 1) / 2 && !whole; ++k) whole = !growing.grow();
      watch.poll();
      RefillCavity cavity(tangle, growing.tets());
      outcome = cavity.fill(filler);
      if (outcome == RefillCavity::Outcome::filled) cavity.apply(tangle);
    }
    if (outcome != RefillCavity::Outcome::filled) {
      stats.overlaps = outcome != RefillCavity::Outcome::not_representable;
      return stats;
    }
    ++stats.cavities;
  }
  stats.done = true;
  return stats;
}

}  // namespace holdfast
