#include "untangle/swap.h"

#include <deque>
#include <optional>

#include "mesh/edge_removal.h"

namespace holdfast {
namespace {

// The shell of edge ab where it is a closed ring within a region, without constraints; else nothing.
bool gather_ring(const Tangle& tangle, Tet first, Vertex a, Vertex b, EdgeShell& out) {
  if (tangle.is_segment(a, b)) return false;
  out.a = a;
  out.b = b;
  out.tets.clear();
  out.link.clear();
  Tet t = first;
  do {
    if (t == kNone || out.tets.size() == kMostLink || tangle.region(t) != tangle.region(first)) return false;
    const auto& cd = kOpposite[static_cast<std::size_t>(tangle.index_of(t, a))]
                              [static_cast<std::size_t>(tangle.index_of(t, b))];
    out.tets.push_back(t);
    out.link.push_back(tangle.corners(t)[static_cast<std::size_t>(cd[0])]);
    if (tangle.is_constraint(tangle.face(t, cd[0]))) return false;
    t = tangle.across(t, cd[0]);
  } while (t != first);
  return true;
}

// The best triangulation of a ring's link by the deficit of the tetrahedra.
class LeastDeficit {
 public:
  using Cost = Deficit;

  LeastDeficit(const Tangle& tangle, const EdgeShell& shell) : tangle_(tangle), shell_(shell) {
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

struct Exchange {
  std::vector<Tet> old_tets;
  std::vector<Tangle::Corners> new_tets;
  double gain = 0;  // of negative volume
  bool found = false;
};

class Swaps {
 public:
  Swaps(Tangle& tangle, Watch& watch) : tangle_(tangle), watch_(watch) {}

  std::size_t run() {
    for (const Tet t : tangle_.nonpositive()) push(t);
    const std::size_t most = 20 * queue_.size() + 1000;
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
    best_ = {};
    const Tangle::Corners c = tangle_.corners(t);
    for (const auto& [i, k] : kEdgeVertex)
      plan_edge_removal(t, c[static_cast<std::size_t>(i)], c[static_cast<std::size_t>(k)]);
    for (int i = 0; i < 4; ++i) plan_face_removal(t, i);
    if (!best_.found) return;
    tangle_.exchange(best_.old_tets, best_.new_tets);
    ++swaps_;
    // Whatever is left near by may have become possible.
    for (const Tangle::Corners& corners : best_.new_tets)
      for (const Vertex v : corners)
        for (const Tet s : tangle_.star(v))
          if (tangle_.sign(s) <= 0) push(s);
  }

  void plan_edge_removal(Tet t, Vertex a, Vertex b) {
    if (!gather_ring(tangle_, t, a, b, shell_) || shell_.size() < 3) return;
    LeastDeficit objective(tangle_, shell_);
    const auto cost = triangulation_.find(shell_.size(), objective);
    const Deficit before = tangle_.deficit(shell_.tets);
    if (!cost || !cost->better_than(before)) return;
    std::vector<LinkTriangle> triangles;
    triangulation_.triangles(shell_.size(), triangles);
    std::vector<Tangle::Corners> tets;
    tetrahedra_of(shell_, triangles, tets);
    propose({shell_.tets, std::move(tets), before.volume.value - cost->volume.value, true});
  }

  //     d above and e below the face (f0 f1 f2): three tetrahedra round the new edge ed.
  void plan_face_removal(Tet t, int i) {
    const auto f = tangle_.face(t, i);
    const Tet s = tangle_.across(t, i);
    if (s == kNone || tangle_.region(s) != tangle_.region(t) || tangle_.is_constraint(f)) return;
    const Vertex d = tangle_.corners(t)[static_cast<std::size_t>(i)];
    Vertex e = kNone;
    for (const Vertex v : tangle_.corners(s))
      if (v != f[0] && v != f[1] && v != f[2]) e = v;
    if (tangle_.has_edge(d, e)) return;
    std::vector<Tangle::Corners> tets;
    Deficit after;
    for (std::size_t k = 0; k < 3; ++k) {
      tets.push_back({f[k], f[(k + 1) % 3], e, d});
      after += tangle_.deficit(tets.back());
    }
    const std::vector<Tet> old{t, s};
    const Deficit before = tangle_.deficit(old);
    if (after.better_than(before))
      propose({old, std::move(tets), before.volume.value - after.volume.value, true});
  }

  void propose(Exchange exchange) {
    if (!best_.found || exchange.gain > best_.gain) best_ = std::move(exchange);
  }

  Tangle& tangle_;
  Watch& watch_;
  std::deque<Tet> queue_;
  std::vector<bool> queued_;
  EdgeShell shell_;
  LinkTriangulation<Deficit> triangulation_;
  Exchange best_;
  std::size_t swaps_ = 0;
};

}  // namespace

std::size_t swap_tets(Tangle& tangle, Watch& watch) { return Swaps(tangle, watch).run(); }

}  // namespace holdfast
