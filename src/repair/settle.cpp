// Joins what lies within a distance of each other by bending facets instead of moving vertices.
#include "repair/settle.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "numbers/sorted.h"
#include "repair/bend.h"
#include "repair/near.h"
#include "repair/passings.h"
#include "repair/plans.h"
#include "surface/aabb_tree.h"

namespace holdfast::repairing {
namespace {

/// Most gaps by which facets bend in one pass: this ends chains that are led to and fro.
constexpr double kMostGapsOfABend = 64;

class Settling {
 public:
  Settling(State& state, const Trouble& trouble, const Settle& how, Work& work, const Step& step)
      : state_(state), trouble_(trouble), how_(how), gap_(how.gap), work_(work), step_(step) {}

  double run() {
    list_vertices();
    if (how_.passings == Passings::bodies) bodies_ = bodies_of(state_);
    const double merged = merge_vertices();
    if (how_.passings != Passings::none) add_passings();
    const double room = how_.most > 0 ? how_.most - merged : kMostGapsOfABend * gap_;
    const double bent =
        bend(state_, trouble_, vertices_, {gap_, room, how_.most_facets, how_.touching}, work_, step_);
    drop_unused(state_);
    return merged + bent;
  }

 private:
  [[nodiscard]] const Point& at(Index v) const { return state_.vertices[v]; }

  /// The vertices of elements in trouble, and all others near them.
  void list_vertices() {
    std::vector<std::uint8_t> used(state_.vertices.size(), 0);
    std::vector<Box> boxes;
    for (const Index f : trouble_.facets) boxes.push_back(box_round(state_, state_.facets[f], gap_));
    for (const Index s : trouble_.segments) boxes.push_back(box_round(state_, state_.segments[s], gap_));
    const AabbTree tree(boxes);
    const auto use = [&](const auto& entities) {
      for (const auto& corners : entities)
        for (const Index v : corners) {
          if (std::exchange(used[v], std::uint8_t{1}) != 0 || !is_finite(v)) continue;
          if (tree.overlaps_any(box_round(state_, std::array{v}, 0))) vertices_.push_back(v);
        }
    };
    use(state_.facets);
    use(state_.segments);
    std::sort(vertices_.begin(), vertices_.end());
  }

  [[nodiscard]] bool is_finite(Index v) const { return holdfast::is_finite(at(v)); }

  // --- 1. Vertices

  double merge_vertices() {
    std::vector<Box> boxes;
    for (const Index v : vertices_) boxes.push_back(box_round(state_, std::array{v}, gap_ / 2));
    const AabbTree tree(boxes);
    std::map<Index, Index> into;
    std::vector<std::uint8_t> is_gone(vertices_.size(), 0);
    double most = 0;
    for (std::size_t i = 0; i < vertices_.size(); ++i) {  // ascending
      if (is_gone[i] != 0) continue;
      const Index v = vertices_[i];
      tree.for_each_item([&](const Box& box) { return !box.overlaps(boxes[i]); },
                         [&](const AabbTree::Item& item) {
                           const Index w = vertices_[item.id];
                           if (w <= v || is_gone[item.id] != 0) return;
                           const double distance = length(at(v) - at(w));
                           const bool may_move = w >= state_.input_vertices || how_.moves_input;
                           if (!may_move || !(distance <= gap_)) return;
                           is_gone[item.id] = 1;
                           into[w] = v;
                           most = std::max(most, distance * (1 + 0x1p-48));
                         });
    }
    if (into.empty()) return 0;
    if (how_.moves_input) move_slots(into);
    const auto rename = [&](auto& entities, auto&& renamed) {
      for (std::size_t i = 0; i < entities.size(); ++i)
        for (Index& v : entities[i])
          if (const auto found = into.find(v); found != into.end()) {
            v = found->second;
            renamed(i);
          }
    };
    rename(state_.facets, [&](std::size_t f) { state_.doubt(f); });
    rename(state_.segments, [](std::size_t) {});
    std::erase_if(vertices_, [&](Index v) { return into.count(v) != 0; });
    return most;
  }

  /// If input vertices move: one keeps its slot, which replaces the vertex it was joined with; so do those
  /// joined with it earlier.
  void move_slots(const std::map<Index, Index>& into) {
    std::map<Point, Index> goes;
    for (const auto& [w, v] : into) goes.emplace(at(w), v);
    for (Index u = 0; u < state_.input_vertices; ++u)
      if (const auto found = goes.find(at(u)); found != goes.end() && is_finite(u))
        state_.vertices[u] = at(found->second);
  }

  // --- 2. Sides that pass each other

  /// Adds vertices there, unless there already is one within the gap. If bodies pass each other nearly
  /// everywhere, their sheets lie upon each other, and vertices would not make them the same.
  void add_passings() {
    const std::vector<SidesPass> passings =
        passings_of(state_, trouble_, how_.passings, bodies_, gap_, work_, step_);
    if (how_.passings == Passings::bodies && passings.size() > most_passings(vertices_.size())) return;
    Cells cells(gap_);
    for (const Index v : vertices_) cells.add(at(v));
    for (const SidesPass& place : passings) {
      if (cells.has_near(place.middle)) continue;
      cells.add(place.middle);
      vertices_.push_back(static_cast<Index>(state_.vertices.size()));
      state_.vertices.push_back(place.middle);
    }
  }

  /// Points by cells of a grid as wide as the gap.
  class Cells {
   public:
    explicit Cells(double gap) : gap_(gap) {}
    void add(const Point& p) { points_[cell(p, {0, 0, 0})].push_back(p); }
    [[nodiscard]] bool has_near(const Point& p) const {
      for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
          for (int z = -1; z <= 1; ++z) {
            const auto found = points_.find(cell(p, {x, y, z}));
            if (found == points_.end()) continue;
            for (const Point& q : found->second)
              if (length(p - q) <= gap_) return true;
          }
      return false;
    }

   private:
    [[nodiscard]] std::array<double, 3> cell(const Point& p, std::array<int, 3> by) const {
      std::array<double, 3> c{};
      for (std::size_t k = 0; k < 3; ++k) c[k] = std::floor(p[k] / gap_) + by[k];
      return c;
    }
    double gap_;
    std::map<std::array<double, 3>, std::vector<Point>> points_;
  };

  State& state_;
  const Trouble& trouble_;
  const Settle& how_;
  const double gap_;
  Work& work_;
  const Step& step_;
  std::vector<Index> vertices_;
  std::vector<Index> bodies_;
};

}  // namespace

Trouble everything(const State& state) {
  const auto is_usable = [&](std::span<const Index> corners) {
    return std::all_of(corners.begin(), corners.end(),
                       [&](Index v) { return v < state.vertices.size() && is_finite(state.vertices[v]); });
  };
  Trouble all;
  for (Index f = 0; f < state.facets.size(); ++f)
    if (is_usable(state.facets[f])) all.facets.push_back(f);
  for (Index s = 0; s < state.segments.size(); ++s)
    if (is_usable(state.segments[s])) all.segments.push_back(s);
  return all;
}

Trouble trouble_of(State& state, const Step& step, const Threads& threads, std::size_t most) {
  const Complex complex = state.complex();
  const Elements elements = elements_of(complex, threads);
  Trouble trouble;
  std::vector<std::uint8_t> is_listed(elements.all.size(), 0);
  const VisitPair visit = [&](Index i, Index j, const Contacts&) {
    for (const Index k : {i, j}) {
      const Element& element = elements.all[k];
      if (std::exchange(is_listed[k], std::uint8_t{1}) != 0) continue;
      if (element.corners == 3) trouble.facets.push_back(element.id);
      if (element.corners == 2) trouble.segments.push_back(element.id);
    }
    return trouble.size() <= most;
  };
  const KnownElements known(state, elements);
  for_each_offending_pair(complex, elements, visit, step, {},
                          {known.known().each, known.known().sheet, is_listed});
  for (const Flaw& flaw : elements.flaws) {
    if (flaw.kind == DefectKind::degenerate_facet) trouble.facets.push_back(flaw.id);
    if (flaw.kind == DefectKind::degenerate_segment) trouble.segments.push_back(flaw.id);
  }
  sort_unique(trouble.facets);
  sort_unique(trouble.segments);
  trouble.is_all = trouble.size() <= most;
  if (trouble.is_all) {
    state.sheet.clear();
    state.known.assign(state.facets.size(), 1);
    state.knows_vertices = true;
    for (const Index f : trouble.facets) state.known[f] = 0;
  }
  return trouble;
}

double settle(State& state, const Trouble& trouble, const Settle& how, Work& work, const Step& step) {
  return Settling(state, trouble, how, work, step).run();
}

}  // namespace holdfast::repairing
