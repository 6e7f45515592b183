#include "repair/strips.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "check_repair/reach.h"
#include "numbers/sorted.h"
#include "repair/children.h"
#include "repair/near.h"
#include "surface/aabb_tree.h"
#include "surface/complex.h"
#include "surface/elements.h"
#include "surface/places.h"

namespace holdfast::repairing {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Connected groups.
class Groups {
 public:
  void clear() {
    for (const Index v : touched_) parent_[v] = no_index;
    touched_.clear();
  }
  Index root(Index v) {
    if (v >= parent_.size()) parent_.resize(v + std::size_t{1}, no_index);
    if (parent_[v] == no_index) {
      parent_[v] = v;
      touched_.push_back(v);
    }
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }
  void join(Index v, Index w) {
    v = root(v);
    w = root(w);
    parent_[std::max(v, w)] = std::min(v, w);
  }

 private:
  std::vector<Index> parent_, touched_;
};

class Strips {
 public:
  Strips(State& state, const State& given, double most, const Step& step, const Threads& threads)
      : state_(state),
        given_(given),
        step_(step),
        threads_(threads),
        before_(most),
        most_(most),
        first_(first_at_places(state.vertices)),
        used_(state.vertices.size(), 0),
        children_(state, given) {
    for (const Triangle& t : state.facets)
      for (const Index v : t) used_[first_[v]] = 1;
  }

  double run() {
    for (Index g = 0; g < given_.facets.size(); ++g)
      if (!is_whole(g)) mend(g);
    if (!added_.empty()) state_.doubt_all();
    return most_;
  }

 private:
  [[nodiscard]] const Point& at(Index v) const { return state_.vertices[v]; }

  [[nodiscard]] Triangle corners_of(Index g) const {
    const Triangle& t = given_.facets[g];
    return {first_[t[0]], first_[t[1]], first_[t[2]]};
  }

  /// Whether the parts of a facet are connected and contain its corners; true if it has no parts.
  [[nodiscard]] bool is_whole(Index g) {
    const std::span<const Index> children = children_.of(g);
    if (children.empty()) return true;
    const Triangle corners = corners_of(g);
    if (std::any_of(corners.begin(), corners.end(), [&](Index v) { return used_[v] == 0; })) return false;
    groups_.clear();
    join_sides(children, [](Index) { return true; });
    return are_joined(corners);
  }

  template <class IsNear>
  void join_sides(std::span<const Index> facets, IsNear&& is_near) {
    for (const Index f : facets) {
      const Triangle& t = state_.facets[f];
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = first_[t[i]], b = first_[t[(i + 1) % 3]];
        if (is_near(a) && is_near(b)) groups_.join(a, b);
      }
    }
  }

  [[nodiscard]] bool are_joined(const Triangle& corners) {
    return groups_.root(corners[0]) == groups_.root(corners[1]) &&
           groups_.root(corners[0]) == groups_.root(corners[2]);
  }

  /// The parts near a facet, and their largest distance from it.
  struct Near {
    std::vector<Index> facets;
    std::map<Index, double> vertices;
  };

  [[nodiscard]] Near near_to(Index g) {
    const Triangle& t = given_.facets[g];
    Near near;
    const Box box = box_round(given_, t, 2 * most_);
    near.facets = facets_near(box);
    for (const Index f : children_.of(g))
      for (const Index v : state_.facets[f]) near.vertices.emplace(first_[v], before_);
    for (const Index v : t)
      if (at(v) == given_.vertices[v]) near.vertices[first_[v]] = 0;
    const checking::Reach reach(before_);
    const std::array<Point, 3> facet{given_.vertices[t[0]], given_.vertices[t[1]], given_.vertices[t[2]]};
    std::vector<Index> others;
    for (const Index f : near.facets)
      for (const Index v : state_.facets[f])
        if (box.overlaps({at(v), at(v)})) others.push_back(first_[v]);
    sort_unique(others);
    for (const Index v : others)
      if (!near.vertices.contains(v) && reach.of_triangle(at(v), facet)) near.vertices.emplace(v, before_);
    return near;
  }

  /// Connects a corner that is separate from the others to the nearest part, and continues from there.
  void mend(Index g) {
    const Triangle corners = corners_of(g);
    const Near near = near_to(g);
    constexpr std::size_t kMany = 1000;
    if (near.vertices.size() > kMany) return;
    groups_.clear();
    join_sides(near.facets, [&](Index v) { return near.vertices.contains(v); });
    for (const Index c : corners)
      for (const auto& [v, unused] : near.vertices)
        if (used_[v] != 0 && length(at(v) - at(c)) <= before_) groups_.join(v, c);
    while (!are_joined(corners)) {
      const std::optional<Segment> link = shortest_link(corners, near);
      if (!link || !add_strip(g, *link, near)) return;
      groups_.join((*link)[0], (*link)[1]);
    }
  }

  /// The shortest link from the group of a corner to something not connected with it.
  std::optional<Segment> shortest_link(const Triangle& corners, const Near& near) {
    std::optional<Segment> link;
    double least = kInfinity;
    const Index last = groups_.root(corners[2]);
    const Index from = groups_.root(corners[0]) != last ? groups_.root(corners[0]) : groups_.root(corners[1]);
    for (const auto& [v, unused] : near.vertices) {
      if (groups_.root(v) != from) continue;
      for (const auto& [w, distance] : near.vertices) {
        if (groups_.root(w) == from) continue;
        const double l = length(at(v) - at(w));
        if (!(l < least)) continue;
        least = l;
        link = Segment{v, w};
      }
    }
    return link;
  }

  /// Adds a facet on a line, with a third corner next to one of its ends.
  bool add_strip(Index g, const Segment& link, const Near& near) {
    const double far = std::max(near.vertices.at(link[0]), near.vertices.at(link[1]));
    const bool is_first = near.vertices.at(link[0]) <= near.vertices.at(link[1]);
    for (const Index end : {link[is_first ? 0 : 1], link[is_first ? 1 : 0]})
      for (const double sign : {1.0, -1.0})
        for (std::size_t k = 0; k < 3; ++k) {
          Point p = at(end);
          p[k] += sign * before_;
          if (p[k] == at(end)[k]) p[k] = std::nextafter(p[k], sign * kInfinity);
          if (!fits(link, p)) continue;
          const double by = std::fabs(p[k] - at(end)[k]) + near.vertices.at(end);
          most_ = std::max({most_, far, std::nextafter(by, kInfinity)});
          add(g, link, p);
          return true;
        }
    return false;
  }

  void add(Index g, const Segment& link, const Point& p) {
    const auto fresh = static_cast<Index>(state_.vertices.size());
    state_.vertices.push_back(p);
    first_.push_back(fresh);
    used_.push_back(1);
    for (const Index v : link) used_[v] = 1;
    added_.push_back(static_cast<Index>(state_.facets.size()));
    state_.facets.push_back({link[0], link[1], fresh});
    state_.facet_parents.add(given_.facet_parents.of(g));
  }

  /// Whether a facet fits together with its neighbours.
  [[nodiscard]] bool fits(const Segment& link, const Point& p) {
    Box box = box_round(state_, link, 0);
    box.extend({p, p});
    State local;
    std::map<Index, Index> number;
    const auto number_of = [&](Index v) {
      const auto [found, is_new] = number.try_emplace(v, static_cast<Index>(local.vertices.size()));
      if (is_new) local.vertices.push_back(at(v));
      return found->second;
    };
    for (const Index f : facets_near(box)) {
      const Triangle& t = state_.facets[f];
      local.facets.push_back({number_of(t[0]), number_of(t[1]), number_of(t[2])});
      local.known.push_back(1);
    }
    for (const Segment& s : state_.segments) local.segments.push_back({number_of(s[0]), number_of(s[1])});
    for (Index v = 0; v < used_.size(); ++v)
      if (used_[v] == 0 && first_[v] == v && is_finite(at(v))) (void)number_of(v);
    const Index a = number_of(link[0]), b = number_of(link[1]);
    const auto c = static_cast<Index>(local.vertices.size());
    if (std::find(local.vertices.begin(), local.vertices.end(), p) != local.vertices.end()) return false;
    local.vertices.push_back(p);
    local.facets.push_back({a, b, c});
    local.known.push_back(0);
    const Complex complex = local.complex();
    const Elements elements = elements_of(complex, threads_);
    bool fits = elements.flaws.empty();
    for_each_offending_pair(
        complex, elements, [&](Index, Index, const Contacts&) { return fits = false; }, step_, {},
        KnownElements(local, elements).known());
    return fits;
  }

  [[nodiscard]] std::vector<Index> facets_near(const Box& box) {
    if (!has_tree_) {
      std::vector<Box> boxes;
      for (const Triangle& t : state_.facets) boxes.push_back(box_round(state_, t, 0));
      tree_ = AabbTree(boxes);
      has_tree_ = true;
    }
    std::vector<Index> near;
    tree_.for_each_item([&](const Box& other) { return !box.overlaps(other); },
                        [&](const AabbTree::Item& item) { near.push_back(item.id); });
    for (const Index f : added_)
      if (box.overlaps(box_round(state_, state_.facets[f], 0))) near.push_back(f);
    std::sort(near.begin(), near.end());
    return near;
  }

  State& state_;
  const State& given_;
  const Step& step_;
  const Threads& threads_;
  const double before_;  // how far the surface was from the input
  double most_;          // and is by now
  std::vector<Index> first_;
  std::vector<std::uint8_t> used_;  // at their places
  const Children children_;
  AabbTree tree_;
  bool has_tree_ = false;
  std::vector<Index> added_;  // facets not yet in the tree
  Groups groups_;
};

}  // namespace

double keep_strips(State& state, const State& given, double most, const Step& step, const Threads& threads) {
  return most == 0 ? most : Strips(state, given, most, step, threads).run();
}

}  // namespace holdfast::repairing
