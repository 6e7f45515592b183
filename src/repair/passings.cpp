#include "repair/passings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "numbers/sorted.h"
#include "repair/near.h"
#include "surface/aabb_tree.h"
#include "surface/complex.h"

namespace holdfast::repairing {
namespace {

using Side = std::array<Index, 2>;

class PassingSides {
 public:
  PassingSides(const State& state, const Trouble& trouble, Passings kind, double gap)
      : state_(state), gap_(gap), only_edges_(kind == Passings::edges) {
    for (const Index f : trouble.facets) add_facet(f);
    for (const Index s : trouble.segments)
      if (const Segment& ends = state.segments[s]; ends[0] != ends[1])
        at_sides_.push_back({ascending(Side(ends)), no_index});
    sort_unique(at_sides_);
    for (std::size_t i = 0; i < at_sides_.size(); ++i)
      if (i == 0 || at_sides_[i].side != at_sides_[i - 1].side) first_.push_back(i);
    first_.push_back(at_sides_.size());
  }

  std::vector<SidesPass> find(Work& work, const Step& step) const {
    std::vector<Box> boxes;
    boxes.reserve(first_.size() - 1);
    for (Index s = 0; s + 1 < first_.size(); ++s) boxes.push_back(box_round(state_, side(s), gap_));
    std::vector<SidesPass> found;
    AabbTree(boxes).for_each_overlap(
        [&](Index i, Index j) {
          ++work.done;
          if (work.is_spent()) return false;
          if (const std::optional<SidesPass> place = pass_at(i, j)) found.push_back(*place);
          return true;
        },
        [](Index, Index) { return false; }, step);
    std::sort(found.begin(), found.end(), [](const SidesPass& x, const SidesPass& y) {
      return std::tie(x.distance, x.middle, x.sides) < std::tie(y.distance, y.middle, y.sides);
    });
    return found;
  }

 private:
  /// A facet at one of its sides, or `no_index` for a segment.
  struct AtSide {
    Side side;
    Index facet;
    auto operator<=>(const AtSide&) const = default;
  };

  [[nodiscard]] const Point& at(Index v) const { return state_.vertices[v]; }
  [[nodiscard]] const Side& side(Index s) const { return at_sides_[first_[s]].side; }
  [[nodiscard]] std::span<const AtSide> at_side(Index s) const {
    return std::span(at_sides_).subspan(first_[s], first_[s + 1] - first_[s]);
  }

  void add_facet(Index f) {
    const Triangle& t = state_.facets[f];
    const bool is_line = t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
    if (is_line && only_edges_) return;
    for (std::size_t i = 0; i < 3; ++i)
      if (t[i] != t[(i + 1) % 3]) at_sides_.push_back({ascending(Side{t[i], t[(i + 1) % 3]}), f});
  }

  [[nodiscard]] std::optional<SidesPass> pass_at(Index i, Index j) const {
    const auto [a, b] = side(i);
    const auto [c, d] = side(j);
    if (a == c || a == d || b == c || b == d) return std::nullopt;
    const Passing passing = pass(at(a), at(b), at(c), at(d));
    if (!(passing.distance <= gap_) || (only_edges_ && !are_edges(i, j))) return std::nullopt;
    Point middle{};
    for (std::size_t k = 0; k < 3; ++k) middle[k] = passing.on_first[k] / 2 + passing.on_second[k] / 2;
    return SidesPass{passing.distance, middle, {side(i), side(j)}};
  }

  [[nodiscard]] bool are_edges(Index i, Index j) const {
    const auto one = at_side(i), other = at_side(j);
    if (one.size() == 1 && other.size() == 1) return true;
    return std::all_of(one.begin(), one.end(), [&](const AtSide& x) {
      return std::all_of(other.begin(), other.end(), [&](const AtSide& y) {
        return x.facet == no_index || y.facet == no_index || !lie_in_each_other(x.facet, y.facet);
      });
    });
  }

  /// Whether all corners of one facet lie within the gap of the other's plane.
  [[nodiscard]] bool lie_in_each_other(Index f, Index g) const {
    return is_in_plane_of(f, g) || is_in_plane_of(g, f);
  }
  [[nodiscard]] bool is_in_plane_of(Index f, Index g) const {
    const auto& [a, b, c] = state_.facets[g];
    const Vector normal = cross(minus(at(b), at(a)), minus(at(c), at(a)));
    const double most = gap_ * length(normal);
    return std::all_of(state_.facets[f].begin(), state_.facets[f].end(),
                       [&](Index v) { return std::fabs(dot(minus(at(v), at(a)), normal)) <= most; });
  }

  const State& state_;
  const double gap_;
  const bool only_edges_;
  std::vector<AtSide> at_sides_;    // by side
  std::vector<std::size_t> first_;  // by number of the side, and the end
};

}  // namespace

std::vector<SidesPass> passings_of(const State& state, const Trouble& trouble, Passings kind, double gap,
                                   Work& work, const Step& step) {
  return PassingSides(state, trouble, kind, gap).find(work, step);
}

}  // namespace holdfast::repairing
