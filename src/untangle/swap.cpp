#include "untangle/swap.h"

#include <deque>
#include <optional>

#include "mesh/exchange.h"
#include "untangle/tuning.h"

namespace holdfast {
namespace {

// The shell of edge ab if it is a closed ring within a region, without constraints; else none.
bool gather_ring(const Tangle& tangle, Tet first, Vertex a, Vertex b, EdgeShell& out) {
  if (tangle.is_segment(a, b)) return false;
  return gather_round(tangle, first, a, b, out, kMostLink, [&](Tet t, int i) {
    if (tangle.is_constraint(tangle.face(t, i))) return kNone;
    const Tet next = tangle.across(t, i);
    return next != kNone && tangle.region(next) == tangle.region(first) ? next : kNone;
  });
}

// The best triangulation of a ring's link by the deficit of the tetrahedra.
class LinkDeficit {
 public:
  using Cost = Deficit;

  LinkDeficit(const Tangle& tangle, const EdgeShell& shell) : tangle_(tangle), shell_(shell) {
    const std::size_t n = shell.size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 2; j < n; ++j)
        taken_[i][j] = (i != 0 || j + 1 != n) && tangle.has_edge(shell.link[i], shell.link[j]);
  }

  [[nodiscard]] static Cost none() { return {}; }
  [[nodiscard]] static Cost join(Cost a, const Cost& b) { return a += b; }
  [[nodiscard]] static bool better(const Cost& a, const Cost& b) { return a.better_than(b); }
  [[nodiscard]] std::optional<Cost> triangle(std::size_t i, std::size_t k, std::size_t j) const {
    if (taken_[i][k] || taken_[k][j] || taken_[i][j]) return std::nullopt;
    const Vertex pi = shell_.link[i], pk = shell_.link[k], pj = shell_.link[j];
    if (shell_.size() == 3 && tangle_.has_face(pi, pk, pj)) return std::nullopt;
    Cost cost = tangle_.deficit({pi, pk, pj, shell_.b});
    return cost += tangle_.deficit({pj, pk, pi, shell_.a});
  }
  [[nodiscard]] static Cost diagonal(std::size_t, std::size_t) { return {}; }

 private:
  const Tangle& tangle_;
  const EdgeShell& shell_;
  std::array<std::array<bool, kMostLink>, kMostLink> taken_{};
};

// The objective of one choice among exchanges in a tangle: the greatest decrease of negative volume. No edge
// or face is made twice (paper, Fig. 12).
class LeastDeficit {
 public:
  using Cost = Deficit;

  explicit LeastDeficit(const Tangle& tangle) : tangle_(tangle) {}

  bool gather_edge(Tet t, int edge, EdgeShell& out) const {
    const auto [a, b] = ends_of_edge(tangle_.corners(t), edge);
    return gather_ring(tangle_, t, a, b, out) && out.size() >= 3;
  }
  bool gather_face(Tet t, int side, SharedFace& out) const {
    const auto f = tangle_.face(t, side);
    const Tet s = tangle_.across(t, side);
    if (s == kNone || tangle_.region(s) != tangle_.region(t) || tangle_.is_constraint(f)) return false;
    out = {{t, s}, f, tangle_.corners(t)[static_cast<std::size_t>(side)], kNone};
    for (const Vertex v : tangle_.corners(s))
      if (v != f[0] && v != f[1] && v != f[2]) out.bottom = v;
    return !tangle_.has_edge(out.top, out.bottom);
  }
  static Tangle::Corners beside(const SharedFace& f, std::size_t k) {
    return {f.v[k], f.v[(k + 1) % 3], f.bottom, f.top};
  }
  [[nodiscard]] std::optional<Deficit> before(std::span<const Tet> tets) const {
    return tangle_.deficit(tets);
  }
  [[nodiscard]] std::optional<Deficit> after(const std::array<Tangle::Corners, 3>& three,
                                             const Deficit&) const {
    Deficit sum;
    for (const Tangle::Corners& c : three) sum += tangle_.deficit(c);
    return sum;
  }
  [[nodiscard]] bool gains(const Deficit& before, const Deficit& after) const {
    return after.better_than(before) && (!found_ || before.volume.value - after.volume.value > gain_);
  }
  bool take(const Deficit& before, const Deficit& after, std::span<const Tangle::Corners>) {
    found_ = true;
    gain_ = before.volume.value - after.volume.value;
    return true;
  }
  [[nodiscard]] LinkDeficit link(const EdgeShell& shell, const Deficit&) const { return {tangle_, shell}; }

 private:
  const Tangle& tangle_;
  bool found_ = false;
  double gain_ = 0;  // of negative volume
};

class Swaps {
 public:
  Swaps(Tangle& tangle, Watch& watch) : tangle_(tangle), watch_(watch) {}

  std::size_t run() {
    for (const Tet t : tangle_.nonpositive()) push(t);
    const std::size_t most = tuning::kSwapTriesATet * queue_.size() + tuning::kLeastSwapTries;
    for (std::size_t k = 0; k < most && !queue_.empty(); ++k) {
      const Tet t = queue_.front();
      queue_.pop_front();
      queued_[t] = false;
      watch_.poll();
      if (tangle_.alive(t) && tangle_.sign(t) <= 0) improve(t);
    }
    return swaps_;
  }

 private:
  void push(Tet t) {
    if (t >= queued_.size()) queued_.resize(tangle_.slot_count(), false);
    if (queued_[t]) return;
    queued_[t] = true;
    queue_.push_back(t);
  }

  void improve(Tet t) {
    LeastDeficit objective(tangle_);
    const Exchange* const best = search_.best_at(t, objective);
    if (best == nullptr) return;
    tangle_.exchange(best->old_tets, best->new_tets);
    ++swaps_;
    // Other exchanges nearby may now be possible.
    for (const Tangle::Corners& corners : best->new_tets)
      for (const Vertex v : corners)
        for (const Tet s : tangle_.star(v))
          if (tangle_.sign(s) <= 0) push(s);
  }

  Tangle& tangle_;
  Watch& watch_;
  std::deque<Tet> queue_;
  std::vector<bool> queued_;
  ExchangeSearch<LeastDeficit> search_;
  std::size_t swaps_ = 0;
};

}  // namespace

std::size_t swap_tets(Tangle& tangle, Watch& watch) { return Swaps(tangle, watch).run(); }

}  // namespace holdfast
