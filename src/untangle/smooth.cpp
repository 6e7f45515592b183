#include "untangle/smooth.h"

#include <algorithm>
#include <cmath>

#include "untangle/foldover_energy.h"
#include "untangle/lbfgs.h"

namespace holdfast {
namespace {

class Smoothing {
 public:
  Smoothing(Tangle& tangle, unsigned rings, Watch& watch) : tangle_(tangle), watch_(watch) {
    choose_vertices(rings);
    choose_tets();
  }

  std::size_t run() {
    if (vertices_.empty()) return 0;
    set_frame();
    FoldoverEnergy energy = make_energy();
    std::vector<double> x = coordinates();
    energy.take_sizes(x);
    const Deficit before = tangle_.deficit(tets_);
    Deficit least = before;
    std::vector<Point> best = positions();
    int idle = 0;
    double value = 0, epsilon = 0;
    for (int k = 0; k < kMostRounds && idle < kMostIdle && least.count > unmovable_; ++k) {
      epsilon = next_epsilon(energy.least_determinant(x), epsilon, k, value);
      energy.set_epsilon(epsilon);
      value = minimise(x, [&](auto at, auto gradient) {
        watch_.poll();
        return energy(at, gradient);
      }, {kIterations, kLeastDecrease});
      place(x);
      const Deficit found = tangle_.deficit(tets_);
      ++idle;
      if (!found.better_than(least)) continue;
      idle = 0;
      least = found;
      best = positions();
    }
    put(best);
    return least.better_than(before) ? vertices_.size() : 0;
  }

 private:
  static constexpr int kMostRounds = 60, kMostIdle = 8, kIterations = 60;
  static constexpr double kLeastDecrease = 1e-4;

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

  // Variables are of the order of one: relative to the middle, in units of the mean edge.
  void set_frame() {
    double sum = 0;
    for (const Tet t : tets_)
      for (const auto& [i, k] : kEdgeVertex) {
        const Point& a = tangle_.position(tangle_.corners(t)[static_cast<std::size_t>(i)]);
        const Point& b = tangle_.position(tangle_.corners(t)[static_cast<std::size_t>(k)]);
        sum += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
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

  // The regularisation follows the worst tetrahedron (the paper's implementation does so too).
  [[nodiscard]] static double next_epsilon(double least_determinant, double, int, double) {
    constexpr double kLeast = 1e-6, kShare = 0.2;
    return std::hypot(kLeast, kShare * std::min(least_determinant, 0.0));
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
  std::vector<Vertex> vertices_;  // that move
  std::vector<Tet> tets_;         // at them
  std::size_t unmovable_ = 0;
  Point middle_{};
  double unit_ = 1;
};

}  // namespace

std::size_t smooth(Tangle& tangle, unsigned rings, Watch& watch) {
  return Smoothing(tangle, rings, watch).run();
}

}  // namespace holdfast
