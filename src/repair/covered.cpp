#include "repair/covered.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "check_repair/cover.h"
#include "check_repair/reach.h"
#include "numbers/sorted.h"
#include "repair/children.h"
#include "repair/numbered_sides.h"
#include "surface/complex.h"
#include "surface/places.h"

namespace holdfast::repairing {
namespace {

using Side = std::array<Index, 2>;  // ascending

class Covers {
 public:
  Covers(const State& state, const State& given, const Step& step)
      : state_(state),
        given_(given),
        step_(step),
        place_(state.vertices.size(), no_index),
        children_(state, given),
        test_(state.vertices, state.facets) {
    const std::vector<Index> first = first_at_places(state.vertices);
    for (const Triangle& t : state.facets)
      for (const Index v : t) place_[first[v]] = std::min(place_[first[v]], v);
    for (Index v = 0; v < place_.size(); ++v) place_[v] = place_[first[v]];
  }

  /// The least multiple of `most` that suffices among those tried; nothing if none does.
  std::optional<double> run(double most) {
    const checking::Reach near(most);
    for (Index g = 0; g < given_.facets.size(); ++g)
      if (!children_.of(g).empty() && !is_whole(g) && !has_its_sides_round_it(g, near)) open_.push_back(g);
    constexpr int kDoublings = 8;
    double distance = most;
    for (int k = 0; k <= kDoublings; ++k, distance *= 2) {
      const checking::Reach reach(distance);
      test_.set(reach);
      std::erase_if(open_, [&](Index g) { return is_covered(g); });
      if (open_.empty()) return distance;
    }
    return std::nullopt;
  }

  /// A distance that suffices for those that no multiple sufficed for. Once everything is within it of
  /// everything else, it does.
  double beyond(double most) {
    for (const Index g : open_)
      for (double distance = std::max(most, gap_at_corners(g)); std::isfinite(distance); distance *= 2) {
        const checking::Reach reach(distance);
        test_.set(reach);
        most = distance;
        if (is_covered(g)) break;
      }
    return most;
  }

 private:
  /// Whether a facet is its own only part.
  [[nodiscard]] bool is_whole(Index g) const {
    const auto parts = children_.of(g);
    return parts.size() == 1 && state_.facets[parts[0]] == given_.facets[g] && has_kept_corners(g);
  }

  [[nodiscard]] bool has_kept_corners(Index g) const {
    const Triangle& t = given_.facets[g];
    return std::all_of(t.begin(), t.end(), [&](Index v) { return at(v) == given_.vertices[v]; });
  }

  /// The sides that an odd number of these facets have.
  void list_odd(std::span<const Index> facets) {
    sides_.clear();
    constexpr std::size_t kFew = 32;
    if (facets.size() <= kFew) {
      for (const Index f : facets) {
        const Triangle& t = state_.facets[f];
        for (std::size_t i = 0; i < 3; ++i)
          sides_.push_back(ascending(Side{place_[t[i]], place_[t[(i + 1) % 3]]}));
      }
      sort_odd(sides_);
      return;
    }
    if (!numbered_) {
      numbered_.emplace(state_.facets, place_);
      is_odd_.resize(numbered_->all.size(), 0);
    }
    for (const Index f : facets)
      for (const Index side : numbered_->of_facets[f]) {
        is_odd_[side] ^= 1u;
        touched_.push_back(side);
      }
    for (const Index side : touched_)
      if (std::exchange(is_odd_[side], std::uint8_t{0}) != 0) sides_.push_back(numbered_->all[side]);
    touched_.clear();
    std::sort(sides_.begin(), sides_.end());
  }

  /// The sides that an odd number of the parts of a facet have, once from each end.
  void list_odd_sides(Index g) {
    list_odd(children_.of(g));
    const std::size_t odd = sides_.size();
    sides_.resize(2 * odd);
    for (std::size_t k = 0; k < odd; ++k) sides_[odd + k] = {sides_[k][1], sides_[k][0]};
    std::sort(sides_.begin(), sides_.end());
  }

  /// The two odd sides from a vertex; nothing if there are more or fewer.
  [[nodiscard]] std::optional<std::array<Index, 2>> ways_from(Index v) const {
    const auto from = std::lower_bound(sides_.begin(), sides_.end(), Side{v, 0});
    const auto left = sides_.end() - from;
    if (left < 2 || (*from)[0] != v || from[1][0] != v || (left > 2 && from[2][0] == v)) return std::nullopt;
    return std::array{(*from)[1], from[1][1]};
  }

  /// Whether one closed line bounds the parts of a facet, passes through its corners, and stays as near to
  /// each of its sides.
  [[nodiscard]] bool has_its_sides_round_it(Index g, const checking::Reach& reach) {
    list_odd_sides(g);
    const Triangle& t = given_.facets[g];
    std::size_t steps = 0;
    Index before = no_index;
    for (std::size_t i = 0; i < 3; ++i) {
      const Index end = place_[t[(i + 1) % 3]];
      for (Index v = place_[t[i]]; v != end || v == no_index; ++steps) {
        const auto ways = v == no_index || steps > sides_.size() ? std::nullopt : ways_from(v);
        if (!ways) return false;
        Index next = (*ways)[(*ways)[0] == before ? 1 : 0];
        // Start in the direction in which the second corner comes before the third.
        if (before == no_index && !leads_to(v, next, end, place_[t[2]])) next = (*ways)[1];
        before = std::exchange(v, next);
        if (v != end && !reach.of_segment(at(v), given_.vertices[t[i]], given_.vertices[t[(i + 1) % 3]]))
          return false;
      }
    }
    return 2 * steps == sides_.size();
  }

  /// Whether the line from v by way of `next` reaches `first` before `second`.
  [[nodiscard]] bool leads_to(Index v, Index next, Index first, Index second) const {
    for (std::size_t steps = 0; next != first && next != second && steps < sides_.size(); ++steps) {
      const auto ways = ways_from(next);
      if (!ways) return false;
      const Index on = (*ways)[(*ways)[0] == v ? 1 : 0];
      v = std::exchange(next, on);
    }
    return next == first;
  }

  /// How far the parts of a facet are from its corners: no less suffices.
  [[nodiscard]] double gap_at_corners(Index g) const {
    double gap = 0;
    for (const Index v : given_.facets[g]) {
      double least = std::numeric_limits<double>::infinity();
      for (const Index f : children_.of(g)) {
        const Triangle& t = state_.facets[f];
        least = std::min(least, checking::rough_distance(given_.vertices[v], {at(t[0]), at(t[1]), at(t[2])}));
      }
      gap = std::max(gap, least);
    }
    constexpr double kRoundedUp = 1 + 0x1p-40;
    return gap * kRoundedUp;
  }

  [[nodiscard]] bool is_covered(Index g) {
    step_(0);
    const Triangle& t = given_.facets[g];
    return !test_.gap({given_.vertices[t[0]], given_.vertices[t[1]], given_.vertices[t[2]]},
                      {place_[t[0]], place_[t[1]], place_[t[2]]}, children_.of(g));
  }

  [[nodiscard]] const Point& at(Index v) const { return state_.vertices[v]; }

  const State& state_;
  const State& given_;
  const Step& step_;
  std::vector<Index> place_;  // by vertex: a used vertex at its place, or none
  const Children children_;
  checking::CoverTest test_;
  std::vector<Index> open_;  // facets that are not yet known to be covered
  std::vector<Side> sides_;
  std::optional<NumberedSides> numbered_;  // for a facet with many parts
  std::vector<std::uint8_t> is_odd_;       // by number, up to now
  std::vector<Index> touched_;
};

}  // namespace

std::optional<double> covered_within(const State& state, const State& given, double most, const Step& step) {
  if (most == 0) return most;
  return Covers(state, given, step).run(most);
}

double cover_distance(const State& state, const State& given, double most, const Step& step) {
  if (most == 0) return most;
  Covers covers(state, given, step);
  const std::optional<double> within = covers.run(most);
  return within ? *within : covers.beyond(most);
}

}  // namespace holdfast::repairing
