#include "repair/snap.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "numbers/sorted.h"
#include "repair/near.h"
#include "surface/box_pairs.h"
#include "surface/elements.h"
#include "surface/places.h"

namespace holdfast::repairing {
namespace {

/// Extended by any box, it is that box.
constexpr Box nowhere() {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  return {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
}

class Snapping {
 public:
  Snapping(State& state, std::span<const Index> part, SnapTo to, double tolerance, const Step& step,
           const Threads& threads)
      : state_(state), to_(to), tolerance_(tolerance), step_(step), threads_(threads) {
    Index parts = 0;
    for (const Index p : part) parts = std::max(parts, p + 1);
    facets_.resize(parts);
    for (Index f = 0; f < state.facets.size(); ++f)
      if (std::all_of(state.facets[f].begin(), state.facets[f].end(),
                      [&](Index v) { return v < state.vertices.size() && is_finite(state.vertices[v]); }))
        facets_[part[f]].push_back(f);
  }

  double run() {
    for (Index p = 0; p < facets_.size(); ++p) {
      std::map<Index, Point> moves = moves_of(p);
      withdraw_invalid(p, moves);
      for (const auto& [v, to] : moves) {
        most_ = std::max(most_, length(at(v) - to) * (1 + 0x1p-48));
        state_.vertices[v] = to;
      }
      boxes_.push_back(box_of(p));
    }
    return most_;
  }

 private:
  [[nodiscard]] const Point& at(Index v) const { return state_.vertices[v]; }

  [[nodiscard]] std::vector<Index> vertices_of(Index part) const {
    std::vector<Index> vertices;
    for (const Index f : facets_[part])
      vertices.insert(vertices.end(), state_.facets[f].begin(), state_.facets[f].end());
    sort_unique(vertices);
    return vertices;
  }

  [[nodiscard]] Box box_of(Index part) const {
    Box box = nowhere();
    for (const Index f : facets_[part]) box.extend(box_round(state_, state_.facets[f], 0));
    return box;
  }

  /// Where a vertex may go. Lower kinds come first, then smaller distances.
  struct Target {
    int kind;
    double distance;
    Point to;
    bool operator<(const Target& other) const {
      return std::tuple(kind, distance, to) < std::tuple(other.kind, other.distance, other.to);
    }
  };

  [[nodiscard]] std::map<Index, Point> moves_of(Index part) const {
    const std::vector<Index> own = vertices_of(part);
    std::vector<Box> round_own, round_before;
    Box reach = nowhere();
    for (const Index v : own) {
      round_own.push_back(box_round(state_, std::array{v}, tolerance_));
      reach.extend(round_own.back());
    }
    std::vector<Index> before;
    for (Index p = 0; p < part; ++p) {
      if (!boxes_[p].overlaps(reach)) continue;
      for (const Index f : facets_[p]) {
        const Box box = box_round(state_, state_.facets[f], 0);
        if (!box.overlaps(reach)) continue;
        before.push_back(f);
        round_before.push_back(box);
      }
    }
    if (before.empty()) return {};
    std::map<Index, Target> best;
    const auto compare = [&](Index i, Index j) {
      const std::optional<Target> target = target_on(at(own[i]), state_.facets[before[j]]);
      if (!target) return true;
      const auto [there, is_new] = best.try_emplace(own[i], *target);
      if (!is_new && *target < there->second) there->second = *target;
      return true;
    };
    for_each_overlap_between(std::move(round_own), round_before, compare, step_);

    std::map<Index, Point> moves;
    for (const auto& [v, target] : best)
      if (target.to != at(v)) moves.emplace(v, target.to);
    return moves;
  }

  [[nodiscard]] std::optional<Target> target_on(const Point& p, const Triangle& t) const {
    std::optional<Target> best;
    const auto take = [&](int kind, double distance, const Point& to) {
      const Target target{kind, distance, to};
      if (distance <= tolerance_ && (!best || target < *best)) best = target;
    };
    for (const Index v : t) take(0, length(p - at(v)), at(v));
    if (to_ == SnapTo::vertices) return best;
    for (std::size_t i = 0; i < 3; ++i) {
      const Nearness near = beside_side(p, at(t[i]), at(t[(i + 1) % 3]));
      take(1, near.distance, near.foot);
    }
    const Nearness near = beside_facet(p, at(t[0]), at(t[1]), at(t[2]));
    take(2, near.distance, near.foot);
    return best;
  }

  /// Withdraws moves until the part is as valid as it was.
  void withdraw_invalid(Index part, std::map<Index, Point>& moves) const {
    if (moves.empty()) return;
    const std::set<std::array<Index, 2>> before = broken(part, {});
    constexpr int kMostRounds = 20;
    for (int round = 0; round < kMostRounds && !moves.empty(); ++round) {
      std::set<Index> back;
      for (const auto& pair : broken(part, moves)) {
        if (before.count(pair) != 0) continue;
        for (const Index f : pair)
          if (f != no_index)
            for (const Index v : state_.facets[f])
              if (moves.count(v) != 0) back.insert(v);
      }
      if (back.empty()) return;
      for (const Index v : back) moves.erase(v);
    }
    moves.clear();
  }

  /// Pairs of facets of a part that do not fit together after the moves, and single facets without area.
  [[nodiscard]] std::set<std::array<Index, 2>> broken(Index part, const std::map<Index, Point>& moves) const {
    // No vertex of another part belongs to this one.
    const std::vector<Index> own = vertices_of(part);
    const auto number = [&](Index v) {
      return static_cast<Index>(std::lower_bound(own.begin(), own.end(), v) - own.begin());
    };
    std::vector<Point> vertices;
    for (const Index v : own) {
      const auto moved = moves.find(v);
      vertices.push_back(moved == moves.end() ? at(v) : moved->second);
    }
    std::vector<Triangle> facets;
    for (const Index f : facets_[part]) {
      const Triangle& t = state_.facets[f];
      facets.push_back({number(t[0]), number(t[1]), number(t[2])});
    }
    const Complex complex{vertices, facets, {}, {}, {}};
    const Elements elements = elements_of(complex, threads_);
    std::set<std::array<Index, 2>> pairs;
    const auto facet = [&](Index element) {
      return elements.all[element].corners == 3 ? facets_[part][elements.all[element].id] : no_index;
    };
    for_each_offending_pair(
        complex, elements,
        [&](Index i, Index j, const Contacts&) {
          pairs.insert({facet(i), facet(j)});
          return true;
        },
        step_);
    for (const Flaw& flaw : elements.flaws)
      if (flaw.kind == DefectKind::degenerate_facet) pairs.insert({facets_[part][flaw.id], no_index});
    return pairs;
  }

  State& state_;
  const SnapTo to_;
  const double tolerance_;
  const Step& step_;
  const Threads& threads_;
  std::vector<std::vector<Index>> facets_;  // by part
  std::vector<Box> boxes_;                  // of the parts that have been moved
  double most_ = 0;
};

}  // namespace

double snap(State& state, std::span<const Index> part, SnapTo to, double tolerance, const Step& step,
            const Threads& threads) {
  return Snapping(state, part, to, tolerance, step, threads).run();
}

}  // namespace holdfast::repairing
