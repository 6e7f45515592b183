#include "repair/fins.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <utility>

#include "numbers/sorted.h"
#include "repair/bounds.h"
#include "repair/near.h"
#include "repair/numbered_sides.h"
#include "repair/open_sides.h"
#include "repair/plans.h"
#include "surface/places.h"

namespace holdfast::repairing {
namespace {

using Side = std::array<Index, 2>;  // ascending; each end is the first vertex at its place

class Fins {
 public:
  Fins(State& state, const State& given, double displaced, double most)
      : state_(state),
        given_(given),
        displaced_(displaced),
        most_(most),
        first_(first_at_places(state.vertices)),
        numbered_(state.facets, first_),
        fin_(state.facets.size()) {
    std::iota(fin_.begin(), fin_.end(), Index{0});
    is_gone_.assign(state.facets.size(), 0);
    list_facets();
    for (const Segment& s : state.segments) held_.insert(ascending(Side{first_[s[0]], first_[s[1]]}));
  }

  double run() {
    peel();
    if (order_.empty()) return 0;
    put_back_bad();
    double largest = 0;
    for (const auto& [f, sum] : sums())
      if (is_gone_[f] != 0) largest = std::max(largest, sum);
    if (largest > 0) deliver();
    return largest;
  }

 private:
  void list_facets() {
    begin_.assign(numbered_.all.size() + 1, 0);
    for (const std::array<Index, 3>& sides : numbered_.of_facets)
      for (const Index side : sides) ++begin_[side + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<Index> next(begin_.begin(), begin_.end() - 1);
    facets_.resize(begin_.back());
    for (Index f = 0; f < numbered_.of_facets.size(); ++f)
      for (const Index side : sides_of(f)) facets_[next[side]++] = f;
  }

  /// The numbers of its sides.
  [[nodiscard]] const std::array<Index, 3>& sides_of(Index f) const { return numbered_.of_facets[f]; }

  [[nodiscard]] std::span<const Index> facets_at(Index side) const {
    return {facets_.data() + begin_[side], facets_.data() + begin_[side + 1]};
  }

  /// The number of remaining facets at the side.
  [[nodiscard]] std::size_t left(Index side) const {
    const std::span<const Index> all = facets_at(side);
    return static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [&](Index f) { return is_gone_[f] == 0; }));
  }

  void peel() {
    std::vector<std::pair<Side, Index>> free;
    for (Index side = 0; side < numbered_.all.size(); ++side)
      if (const auto facets = facets_at(side); facets.size() == 1)
        free.emplace_back(numbered_.all[side], facets[0]);
    std::sort(free.begin(), free.end());
    std::vector<Index> next;
    for (const auto& [side, f] : free) next.push_back(f);
    while (!next.empty()) {
      const Index f = next.back();
      next.pop_back();
      if (is_gone_[f] != 0) continue;
      const double distance = thickness(f);
      if (!(distance <= most_)) continue;
      is_gone_[f] = 1;
      order_.emplace_back(f, distance);
      for (const Index side : sides_of(f))
        for (const Index g : facets_at(side)) {
          if (is_gone_[g] != 0)
            fin_[root(g)] = root(f);
          else if (left(side) == 1)
            next.push_back(g);
        }
    }
  }

  /// An earlier fin may lie on a later one, so their distances add up: the sums by fin, named by one of its
  /// facets.
  [[nodiscard]] std::map<Index, double> sums() const {
    std::map<Index, double> sums;
    for (const auto& [f, distance] : order_) {
      double& sum = sums[root(f)];
      sum = std::nextafter(sum + distance, std::numeric_limits<double>::infinity());
    }
    return sums;
  }

  /// The largest distance of points of a facet from its shared sides. The distance from a side is convex, so
  /// corners decide. For two sides, the facet is divided at the foot of their common corner, and the same
  /// holds for each half.
  [[nodiscard]] double thickness(Index f) const {
    const std::array<Index, 3>& sides = sides_of(f);
    std::array<bool, 3> is_free{};
    for (std::size_t i = 0; i < 3; ++i) {
      is_free[i] = left(sides[i]) == 1;
      if (is_free[i] && held_.contains(numbered_.all[sides[i]]))
        return std::numeric_limits<double>::infinity();
    }
    const Triangle& t = state_.facets[f];
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
      if (!is_free[i]) least = std::min(least, distance(c, a, b));
      if (is_free[i] && !is_free[(i + 1) % 3] && !is_free[(i + 2) % 3])
        least = std::min(least, distance(c, a, b));
    }
    return least;
  }

  /// The distance of a vertex from a side, rounded up.
  [[nodiscard]] double distance(Index v, Index a, Index b) const {
    const double to_ends = std::min(length(at(v) - at(a)), length(at(v) - at(b))) * (1 + 0x1p-48);
    return std::min(beside_side(at(v), at(a), at(b)).bound(), to_ends);
  }

  /// For each fin and each input facet that it has parts of, the boundary of these parts: sides modulo 2.
  [[nodiscard]] std::map<std::array<Index, 2>, std::set<Side>> ends() const {
    std::map<std::array<Index, 2>, std::set<Side>> ends;
    for (const auto& [f, distance] : order_)
      for (const Index p : state_.facet_parents.of(f)) {
        std::set<Side>& sides = ends[{root(f), p}];
        for (const Index side : sides_of(f))
          if (!sides.insert(numbered_.all[side]).second) sides.erase(numbered_.all[side]);
      }
    return ends;
  }

  /// Fins that contain the start of a side of an input facet, at its corner, if no sides of remaining facets
  /// lead along it. These may deviate from it by the thickness of the fin plus what was displaced before,
  /// since both are reported.
  [[nodiscard]] std::set<Index> at_corners() const {
    const auto all = ends();
    const std::map<Index, double> thickness = sums();
    std::map<Index, std::vector<Index>> fins_of;  // by facet of the input
    for (const auto& [of, sides] : all) fins_of[of[1]].push_back(of[0]);
    std::set<Index> found;
    for (Index g = 0; g < given_.facets.size(); ++g)
      for (const Index p : given_.facet_parents.of(g)) {
        const auto fins = fins_of.find(p);
        if (fins == fins_of.end()) continue;
        for (const Index fin : fins->second)
          if (takes_corner(all.at({fin, p}), given_.facets[g], sum_above(displaced_, thickness.at(fin))))
            found.insert(fin);
      }
    return found;
  }

  /// Whether a side of an input facet loses its start to a fin with these ends.
  [[nodiscard]] bool takes_corner(const std::set<Side>& ends, const Triangle& facet, double most) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const Index corner = first_[facet[i]];
      const bool is_there = std::any_of(ends.begin(), ends.end(),
                                        [&](const Side& s) { return s[0] == corner || s[1] == corner; });
      const auto leads_to = [&](std::size_t to) { return is_led(facet[i], facet[to % 3], most); };
      if (is_there && !(leads_to(i + 1) && leads_to(i + 2))) return true;
    }
    return false;
  }

  /// Whether sides of remaining facets lead from one input vertex to another and stay within `most` of the
  /// straight line between them.
  [[nodiscard]] bool is_led(Index from, Index to, double most) const {
    const Point &a = given_.vertices[from], &b = given_.vertices[to];
    const auto is_near = [&](Index v) {
      const double to_ends = std::min(length(at(v) - a), length(at(v) - b)) * (1 + 0x1p-48);
      return std::min(beside_side(at(v), a, b).bound(), to_ends) <= most;
    };
    std::vector<Index> open{first_[from]};
    std::set<Index> seen{first_[from]};
    while (!open.empty()) {
      const Index v = open.back();
      open.pop_back();
      if (v == first_[to]) return true;
      for (const Index w : neighbours(v))
        if ((w == first_[to] || is_near(w)) && seen.insert(w).second) open.push_back(w);
    }
    return false;
  }

  /// The other ends of sides of remaining facets.
  [[nodiscard]] std::vector<Index> neighbours(Index v) const {
    std::vector<Index> found;
    if (sides_at_.empty()) {
      sides_at_.resize(state_.vertices.size());
      for (Index side = 0; side < numbered_.all.size(); ++side)
        for (const Index w : numbered_.all[side]) sides_at_[w].push_back(side);
    }
    for (const Index side : sides_at_[v])
      if (const auto& [a, b] = numbered_.all[side]; left(side) > 0) found.push_back(a == v ? b : a);
    return found;
  }

  /// Puts back fins that leave a free side, are too thick, contain the last part of a facet or the last facet
  /// of an input vertex, or contain the start of a side.
  void put_back_bad() {
    std::map<Index, std::size_t> parts, uses;  // of input facets and vertices in fins
    const auto each = [&](Index f, auto&& part, auto&& use) {
      for (const Index p : state_.facet_parents.of(f)) part(p);
      for (const Index v : state_.facets[f])
        if (v < state_.input_vertices) use(v);
    };
    for (const auto& [f, distance] : order_)
      each(
          f, [&](Index p) { parts[p] = 0; }, [&](Index v) { uses[v] = 0; });
    for (Index f = 0; f < is_gone_.size(); ++f) {
      if (is_gone_[f] != 0) continue;
      each(
          f,
          [&](Index p) {
            if (const auto found = parts.find(p); found != parts.end()) ++found->second;
          },
          [&](Index v) {
            if (const auto found = uses.find(v); found != uses.end()) ++found->second;
          });
    }
    std::set<Index> bad = at_corners();
    for (const auto& [f, sum] : sums())
      if (!(sum <= most_)) bad.insert(f);
    for (const auto& [f, distance] : order_) {
      bool is_bad = false;
      for (const Index side : sides_of(f)) is_bad |= left(side) == 1;
      each(
          f, [&](Index p) { is_bad |= parts[p] == 0; }, [&](Index v) { is_bad |= uses[v] == 0; });
      if (is_bad) bad.insert(root(f));
    }
    for (const auto& [f, distance] : order_)
      if (bad.contains(root(f))) is_gone_[f] = 0;
  }

  void deliver() {
    std::vector<Triangle> facets;
    Parents parents;
    for (Index f = 0; f < is_gone_.size(); ++f) {
      if (is_gone_[f] != 0) continue;
      facets.push_back(state_.facets[f]);
      parents.add(state_.facet_parents.of(f));
    }
    state_.facets = std::move(facets);
    state_.facet_parents = std::move(parents);
    state_.doubt_all();
    drop_unused(state_);
  }

  [[nodiscard]] const Point& at(Index v) const { return state_.vertices[v]; }
  [[nodiscard]] Index root(Index f) const {
    while (fin_[f] != f) f = fin_[f];
    return f;
  }

  State& state_;
  const State& given_;
  const double displaced_, most_;
  const std::vector<Index> first_;
  const NumberedSides numbered_;
  std::vector<Index> begin_, facets_;                 // the facets of each side, and where they begin
  mutable std::vector<std::vector<Index>> sides_at_;  // by vertex, once asked for
  std::set<Side> held_;                               // sides that are segments
  std::vector<std::uint8_t> is_gone_;
  std::vector<Index> fin_;                       // for each removed facet, another facet of its fin
  std::vector<std::pair<Index, double>> order_;  // removed facets and their distances from the rest
};

}  // namespace

/// Thicker fins get a second try: connected facets are removed together or not at all.
double drop_fins(State& state, const State& given, double displaced) {
  const double thin = Fins(state, given, displaced, displaced).run();
  displaced = sum_above(displaced, thin);
  const double joined = kPlans[0].last_bits * last_bit(state.vertices);
  if (!(displaced < joined) || open_sides(state) <= open_sides(given)) return thin;
  return sum_above(thin, Fins(state, given, displaced, joined).run());
}

}  // namespace holdfast::repairing
