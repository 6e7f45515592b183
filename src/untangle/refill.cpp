#include "untangle/refill.h"

#include <unordered_set>

#include "untangle/refill_cavity.h"

namespace holdfast {
namespace {

// A set of tetrahedra that grows by the tetrahedra that share a vertex with it.
class Growing {
 public:
  explicit Growing(const Tangle& tangle) : tangle_(tangle) {}

  void add(Tet t) {
    if (taken_.insert(t).second) tets_.push_back(t);
  }
  /// Returns false if there is nothing left to add.
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
  std::unordered_set<Tet> taken_;  // a hash set, because cavities are mostly small, and many
  std::vector<Tet> tets_;
  std::size_t grown_ = 0;
};

// Adds the non-positive tetrahedra connected by vertices.
void add_cluster(const Tangle& tangle, Tet seed, Growing& cavity) {
  cavity.add(seed);
  for (std::size_t k = 0; k < cavity.tets().size(); ++k) {
    const Tangle::Corners corners = tangle.corners(cavity.tets()[k]);
    for (const Vertex v : corners)
      for (const Tet s : tangle.star(v))
        if (tangle.sign(s) <= 0) cavity.add(s);
  }
}

// Grows the cavity until the filler can fill it, or until it is the whole connected part.
RefillCavity::Outcome fill_round(Tangle& tangle, Tet seed, const CavityFiller& filler, Watch& watch) {
  Growing growing(tangle);
  add_cluster(tangle, seed, growing);
  bool whole = false;
  for (int layers = 1;; layers *= 2) {
    for (int k = 0; k < (layers + 1) / 2 && !whole; ++k) whole = !growing.grow();
    watch.poll();
    RefillCavity cavity(tangle, growing.tets());
    const auto outcome = cavity.fill(filler);
    if (outcome == RefillCavity::Outcome::filled) cavity.apply(tangle);
    if (outcome == RefillCavity::Outcome::filled || whole) return outcome;
  }
}

}  // namespace

RefillStats refill(Tangle& tangle, const CavityFiller& filler, Watch& watch) {
  RefillStats stats;
  for (const Tet t : tangle.nonpositive()) {
    // Removed with another cavity. (A new tetrahedron, which is positive, may have its slot.)
    if (!tangle.alive(t) || tangle.sign(t) > 0) continue;
    const auto outcome = fill_round(tangle, t, filler, watch);
    if (outcome != RefillCavity::Outcome::filled) {
      stats.outside = outcome == RefillCavity::Outcome::outside;
      stats.overlaps =
          outcome == RefillCavity::Outcome::overlaps || outcome == RefillCavity::Outcome::invalid;
      return stats;
    }
    ++stats.cavities;
  }
  stats.done = true;
  return stats;
}

}  // namespace holdfast
