#include "repair/passings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include "mesh/disjoint_sets.h"
#include "numbers/sorted.h"
#include "repair/near.h"
#include "surface/aabb_tree.h"
#include "surface/complex.h"
#include "surface/places.h"

namespace holdfast::repairing {
namespace {

using Side = std::array<Index, 2>;

/// A facet at one of its sides, or `no_index` for a segment.
struct AtSide {
  Side side;
  Index facet;
  auto operator<=>(const AtSide&) const = default;
};

void add_sides(const Triangle& corners, Index facet, std::vector<AtSide>& at_sides) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Index a = corners[i], b = corners[(i + 1) % 3];
    if (a != b) at_sides.push_back({ascending(Side{a, b}), facet});
  }
}

class PassingSides {
 public:
  PassingSides(const State& state, const Trouble& trouble, Passings kind, std::span<const Index> bodies,
               double gap)
      : state_(state), bodies_(bodies), gap_(gap), kind_(kind) {
    for (const Index f : trouble.facets) {
      const Triangle& t = state.facets[f];
      const bool is_line = t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
      if (!is_line || kind_ == Passings::all) add_sides(t, f, at_sides_);
    }
    for (const Index s : trouble.segments)
      if (const Segment& ends = state.segments[s]; ends[0] != ends[1] && kind_ == Passings::all)
        at_sides_.push_back({ascending(Side(ends)), no_index});
    sort_unique(at_sides_);
    list_sides();
  }

  std::vector<SidesPass> find(Work& work, const Step& step) const {
    std::vector<Box> boxes;
    boxes.reserve(sides_.size());
    for (const auto& at_side : sides_) boxes.push_back(box_round(state_, at_side[0].side, gap_));
    std::vector<SidesPass> found;
    AabbTree(boxes).for_each_overlap(
        [&](Index i, Index j) {
          ++work.done;
          if (work.is_spent()) return false;
          if (const std::optional<SidesPass> place = pass_at(sides_[i], sides_[j])) found.push_back(*place);
          return true;
        },
        [](Index, Index) { return false; }, step);
    std::sort(found.begin(), found.end(), [](const SidesPass& x, const SidesPass& y) {
      return std::tie(x.distance, x.middle) < std::tie(y.distance, y.middle);
    });
    return found;
  }

 private:
  [[nodiscard]] const Point& at(Index v) const { return state_.vertices[v]; }

  /// Of one body, only the free sides matter.
  void list_sides() {
    const auto is_of_first = [&](const AtSide& x) { return bodies_[x.facet] == bodies_[at_sides_[0].facet]; };
    const bool are_all =
        kind_ != Passings::bodies || !std::all_of(at_sides_.begin(), at_sides_.end(), is_of_first);
    for (std::size_t i = 0, next = 0; i < at_sides_.size(); i = next) {
      next = i + 1;
      while (next < at_sides_.size() && at_sides_[next].side == at_sides_[i].side) ++next;
      if (are_all || next - i == 1) sides_.push_back(std::span(at_sides_).subspan(i, next - i));
    }
  }

  using Facets = std::span<const AtSide>;  // of a side

  [[nodiscard]] std::optional<SidesPass> pass_at(Facets one, Facets other) const {
    const auto [a, b] = one[0].side;
    const auto [c, d] = other[0].side;
    if (a == c || a == d || b == c || b == d) return std::nullopt;
    const bool is_clear = kind_ == Passings::all || (one.size() == 1 && other.size() == 1);
    if (kind_ == Passings::bodies && !is_clear && !are_of_two_bodies(one, other)) return std::nullopt;
    const Passing passing = pass(at(a), at(b), at(c), at(d));
    if (!(passing.distance <= gap_)) return std::nullopt;
    if (!is_clear && lie_in_each_other(one, other)) return std::nullopt;
    Point middle{};
    for (std::size_t k = 0; k < 3; ++k) middle[k] = passing.on_first[k] / 2 + passing.on_second[k] / 2;
    return SidesPass{passing.distance, middle};
  }

  [[nodiscard]] bool are_of_two_bodies(Facets one, Facets other) const {
    return std::none_of(one.begin(), one.end(), [&](const AtSide& x) {
      return std::any_of(other.begin(), other.end(),
                         [&](const AtSide& y) { return bodies_[x.facet] == bodies_[y.facet]; });
    });
  }

  [[nodiscard]] bool lie_in_each_other(Facets one, Facets other) const {
    return std::any_of(one.begin(), one.end(), [&](const AtSide& x) {
      return std::any_of(other.begin(), other.end(), [&](const AtSide& y) {
        return lies_in_plane_of(x.facet, y.facet) || lies_in_plane_of(y.facet, x.facet);
      });
    });
  }

  /// All corners of f lie within the gap of the plane of g.
  [[nodiscard]] bool lies_in_plane_of(Index f, Index g) const {
    const Triangle& t = state_.facets[g];
    const Point& origin = at(t[0]);
    const Vector normal = cross(at(t[1]) - origin, at(t[2]) - origin);
    const double most = gap_ * length(normal);
    return std::all_of(state_.facets[f].begin(), state_.facets[f].end(),
                       [&](Index v) { return std::fabs(dot(at(v) - origin, normal)) <= most; });
  }

  const State& state_;
  const std::span<const Index> bodies_;
  const double gap_;
  const Passings kind_;
  std::vector<AtSide> at_sides_;
  std::vector<Facets> sides_;
};

}  // namespace

std::vector<Index> bodies_of(const State& state) {
  const std::vector<Index> first = first_at_places(state.vertices);
  std::vector<AtSide> at_sides;
  at_sides.reserve(3 * state.facets.size());
  for (Index f = 0; f < state.facets.size(); ++f) {
    Triangle corners = state.facets[f];
    for (Index& v : corners)
      if (v < first.size() && first[v] != no_index) v = first[v];
    add_sides(corners, f, at_sides);
  }
  std::sort(at_sides.begin(), at_sides.end());
  DisjointSets bodies(state.facets.size());
  for (std::size_t i = 1; i < at_sides.size(); ++i)
    if (at_sides[i].side == at_sides[i - 1].side) bodies.unite(at_sides[i].facet, at_sides[i - 1].facet);
  std::vector<Index> body(state.facets.size());
  for (Index f = 0; f < body.size(); ++f) body[f] = bodies.root(f);
  return body;
}

std::vector<SidesPass> passings_of(const State& state, const Trouble& trouble, Passings kind,
                                   std::span<const Index> bodies, double gap, Work& work, const Step& step) {
  return PassingSides(state, trouble, kind, bodies, gap).find(work, step);
}

}  // namespace holdfast::repairing
