#include "untangle/smooth.h"

#include <algorithm>
#include <cmath>

#include "numbers/elementary.h"
#include "numbers/sorted.h"
#include "untangle/foldover_energy.h"
#include "untangle/lbfgs.h"
#include "untangle/tuning.h"

namespace holdfast {
namespace {

class Smoothing {
 public:
  Smoothing(Tangle& tangle, unsigned rings, Watch& watch) : tangle_(tangle), watch_(watch) {
    choose_vertices(rings);
    choose_tets();
  }

  bool run() {
    if (vertices_.empty()) return false;
    set_frame();
    const FoldoverEnergy energy = make_energy();
    const std::vector<Point> start = positions();
    const Deficit before = tangle_.deficit(tets_);
    best_ = {start, before};
    // Far from any valid mesh, the mean of the neighbours is a better start than the present positions; near
    // one, it is worse.
    relax();
    descend(energy);
    if (best_.deficit.count > 0) {
      put(start);
      descend(energy);
    }
    put(best_.positions);
    return best_.deficit.better_than(before);
  }

 private:
  struct Best {
    std::vector<Point> positions;
    Deficit deficit;
  };

  void keep_if_better() {
    const Deficit found = tangle_.deficit(tets_);
    if (found.better_than(best_.deficit)) best_ = {positions(), found};
  }

  // Moves each vertex to the mean of its neighbours, repeatedly (successive over-relaxation).
  void relax() {
    std::vector<std::vector<Vertex>> neighbours;
    for (const Vertex v : vertices_) neighbours.push_back(neighbours_of(v));
    std::vector<Point> p(tangle_.points().positions().begin(), tangle_.points().positions().end());
    for (int sweep = 0; sweep < tuning::kRelaxSweeps; ++sweep) {
      watch_.poll_slow_loop();
      for (std::size_t i = 0; i < vertices_.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) {
          double mean = 0;
          for (const Vertex w : neighbours[i]) mean += p[w][c] / static_cast<double>(neighbours[i].size());
          p[vertices_[i]][c] += tuning::kOverRelaxation * (mean - p[vertices_[i]][c]);
        }
    }
    for (const Vertex v : vertices_)
      if (std::isfinite(p[v][0] + p[v][1] + p[v][2])) tangle_.move_vertex(v, p[v]);
    keep_if_better();
  }

  [[nodiscard]] std::vector<Vertex> neighbours_of(Vertex v) const {
    std::vector<Vertex> out;
    for (const Tet t : tangle_.star(v))
      for (const Vertex w : tangle_.corners(t))
        if (w != v) out.push_back(w);
    sort_unique(out);
    return out;
  }

  // Minimises for a shrinking regularisation, with a few iterations for each value, because the next value
  // changes the goal.
  void descend(FoldoverEnergy energy) {
    std::vector<double> x = coordinates();
    energy.take_sizes(x);
    double epsilon = tuning::kFirstEpsilon;
    Deficit least = tangle_.deficit(tets_);
    for (int k = 0, idle = 0;
         k < tuning::kMostEpsilons && idle < tuning::kMostIdleEpsilons && best_.deficit.count > 0;
         ++k, ++idle) {
      energy.set_epsilon(epsilon);
      const double value = energy.value(x);
      const double reached =
          minimise(x, function(energy), {tuning::kIterationsAnEpsilon, tuning::kLeastDescentOfEpsilon});
      epsilon = next_epsilon(epsilon, energy.least_determinant(x), reached / value);
      place(x);
      keep_if_better();
      const Deficit found = tangle_.deficit(tets_);
      if (!found.better_than(least)) continue;
      least = found;
      idle = 0;
    }
  }

  void choose_vertices(unsigned rings) {
    std::vector<bool> seen(tangle_.vertex_count(), false);
    std::vector<Vertex> front;
    const auto reach = [&](Tet t, std::vector<Vertex>& out) {
      for (const Vertex v : tangle_.corners(t))
        if (!seen[v]) {
          seen[v] = true;
          out.push_back(v);
        }
    };
    for (const Tet t : tangle_.nonpositive()) reach(t, front);
    std::vector<Vertex> all = front;
    for (unsigned ring = 1; ring < rings && !front.empty(); ++ring) {
      std::vector<Vertex> next;
      for (const Vertex v : front)
        for (const Tet t : tangle_.star(v)) reach(t, next);
      all.insert(all.end(), next.begin(), next.end());
      front = std::move(next);
    }
    for (const Vertex v : all)
      if (!tangle_.is_fixed(v)) vertices_.push_back(v);
    std::sort(vertices_.begin(), vertices_.end());
  }

  // Tetrahedra whose corners are all fixed cannot change: they would only keep epsilon large.
  void choose_tets() {
    std::vector<bool> seen(tangle_.slot_count(), false);
    for (const Vertex v : vertices_)
      for (const Tet t : tangle_.star(v))
        if (!seen[t]) {
          seen[t] = true;
          tets_.push_back(t);
        }
    std::sort(tets_.begin(), tets_.end());
  }

  // Variables are of order one: relative to the middle, in units of the mean edge.
  void set_frame() {
    double sum = 0;
    for (const Tet t : tets_)
      for (int edge = 0; edge < 6; ++edge) {
        const auto [v, w] = ends_of_edge(tangle_.corners(t), edge);
        const Point &a = tangle_.position(v), &b = tangle_.position(w);
        sum += numbers::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
      }
    unit_ = sum / (6 * static_cast<double>(tets_.size()));
    if (!(unit_ > 0) || !std::isfinite(unit_)) unit_ = 1;
    for (const Vertex v : vertices_)
      for (std::size_t c = 0; c < 3; ++c)
        middle_[c] += tangle_.position(v)[c] / static_cast<double>(vertices_.size());
  }

  [[nodiscard]] std::array<double, 3> local(Vertex v) const {
    const Point& p = tangle_.position(v);
    return {(p[0] - middle_[0]) / unit_, (p[1] - middle_[1]) / unit_, (p[2] - middle_[2]) / unit_};
  }

  FoldoverEnergy make_energy() {
    const auto variable = static_cast<std::uint32_t>(vertices_.size());
    std::vector<std::uint32_t> number(tangle_.vertex_count(), kNone);
    for (std::uint32_t i = 0; i < variable; ++i) number[vertices_[i]] = i;
    std::vector<std::array<double, 3>> fixed;
    std::vector<FoldoverEnergy::Corners> tets;
    for (const Tet t : tets_) {
      FoldoverEnergy::Corners corners{};
      for (std::size_t i = 0; i < 4; ++i) {
        const Vertex v = tangle_.corners(t)[i];
        if (number[v] == kNone) {
          number[v] = variable + static_cast<std::uint32_t>(fixed.size());
          fixed.push_back(local(v));
        }
        corners[i] = number[v];
      }
      tets.push_back(corners);
    }
    return {std::move(tets), variable, std::move(fixed)};
  }

  [[nodiscard]] std::vector<double> coordinates() const {
    std::vector<double> x;
    for (const Vertex v : vertices_)
      for (const double c : local(v)) x.push_back(c);
    return x;
  }

  ValueAndGradient function(const FoldoverEnergy& energy) {
    return [&](std::span<const double> x, std::span<double> gradient) {
      watch_.poll_slow_loop();
      return energy(x, gradient);
    };
  }

  // Chosen so that chi of the worst tetrahedron shrinks by at least a tenth, and by more if the energy fell
  // by more. Then a finite number of rounds untangles every mesh that can be untangled (§3.2 of the paper).
  [[nodiscard]] static double next_epsilon(double epsilon, double least_determinant, double ratio) {
    const double d = least_determinant;
    const double root = numbers::hypot(epsilon, d);
    const double chi = d > 0 ? (d + root) / 2 : epsilon * epsilon / (2 * (root - d));
    const double mu = std::min(ratio, tuning::kMostOfChi) * chi;
    return d < mu ? std::max(tuning::kLeastEpsilon, 2 * std::sqrt(mu * (mu - d))) : tuning::kLeastEpsilon;
  }

  void place(const std::vector<double>& x) {
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      Point p{};
      for (std::size_t c = 0; c < 3; ++c) p[c] = middle_[c] + unit_ * x[3 * i + c];
      if (std::isfinite(p[0] + p[1] + p[2])) tangle_.move_vertex(vertices_[i], p);
    }
  }

  [[nodiscard]] std::vector<Point> positions() const {
    std::vector<Point> out;
    for (const Vertex v : vertices_) out.push_back(tangle_.position(v));
    return out;
  }
  void put(const std::vector<Point>& at) {
    for (std::size_t i = 0; i < vertices_.size(); ++i) tangle_.move_vertex(vertices_[i], at[i]);
  }

  Tangle& tangle_;
  Watch& watch_;
  std::vector<Vertex> vertices_;  // that may move
  std::vector<Tet> tets_;         // at them
  Point middle_{};
  double unit_ = 1;
  Best best_;
};

}  // namespace

bool smooth(Tangle& tangle, unsigned rings, Watch& watch) { return Smoothing(tangle, rings, watch).run(); }

}  // namespace holdfast
