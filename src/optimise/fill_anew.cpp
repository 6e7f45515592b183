#include "optimise/fill_anew.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "mesh/traverse.h"
#include "optimise/forced_apex.h"
#include "optimise/polyhedron.h"
#include "optimise/tuning.h"

namespace holdfast {
namespace {

// Points pay if the quality gets better by a factor of at least their number, and of at least ten.
bool are_points_worth_it(const Search& search, const Search::Trial& trial, double gain) {
  const std::size_t points = search.points_in_mesh();
  return points <= trial.points() ||
         gain >= std::max(tuning::kLeastPointGain, static_cast<double>(points - trial.points()));
}

bool may_pay(const Polyhedron& polyhedron) {
  return polyhedron.may_be_filled_below(polyhedron.worst() / tuning::kLeastGainOfFilling);
}

bool fill_anew(Search& search, const Polyhedron& polyhedron, const Filler& fill, const LikelyToFill& likely) {
  if (!may_pay(polyhedron)) return false;
  const std::optional<Filling> filling = fill(polyhedron.with({}), likely);
  search.poll();
  if (!filling || !polyhedron.is_filled_by(*filling)) return false;
  const double gain = polyhedron.worst() / polyhedron.worst(*filling);
  if (gain < tuning::kLeastGainOfFilling) return false;
  Search::Trial trial(search, Search::Trial::Agenda::set_aside);
  if (const auto added = polyhedron.replace(*filling)) {
    search.add_points(*added);
    trial.improve_what_changed();
    if (trial.has_paid() && are_points_worth_it(search, trial, gain)) {
      ++search.stats().filled_anew;
      ++search.stats().changed;
      return true;
    }
  }
  trial.take_back();
  return false;
}

using LeftOut = std::vector<TetMesh::Corners>;

void leave_out(Search& search, const Polyhedron& polyhedron, LeftOut& left_out) {
  for (const Tet t : polyhedron.tets()) left_out.push_back(search.mesh().corners(t));
}

// The likely next requests if this polyhedron pays, or if larger ones fail, unless that changes them:
// polyhedra round the worst elements elsewhere.
std::vector<ToFill> likely_after(Search& search, const Polyhedron& polyhedron, LeftOut left_out,
                                 double worth_it, std::size_t most) {
  std::vector<ToFill> likely;
  leave_out(search, polyhedron, left_out);
  while (likely.size() < most) {
    const std::optional<WaitingElement> worst = search.worst(left_out);
    if (!worst || worst->quality < worth_it) break;
    left_out.push_back(worst->corners);
    if (!may_be_better(search.mesh(), *worst, search.threads())) continue;
    const Polyhedron next(search, {worst->tet}, tuning::kFilledAnew.front());
    leave_out(search, next, left_out);
    if (may_pay(next)) likely.push_back(next.with({}));
  }
  return likely;
}

// If an element cannot be improved, everything near it is left out from then on, and others that are as bad
// are looked for.
bool fill_anew_round(Search& search, const WaitingElement& worst, const Filler& fill, LeftOut& left_out,
                     double worth_it) {
  left_out.push_back(worst.corners);
  if (!may_be_better(search.mesh(), worst, search.threads())) return false;
  for (const std::size_t most : tuning::kFilledAnew) {
    const Polyhedron polyhedron(search, {worst.tet}, most);
    const auto likely = [&](std::size_t count) {
      return likely_after(search, polyhedron, left_out, worth_it, count);
    };
    if (fill_anew(search, polyhedron, fill, likely)) return true;
    if (most == tuning::kFilledAnew.front()) leave_out(search, polyhedron, left_out);
    // If these are all tetrahedra, larger polyhedra would be the same.
    if (polyhedron.tets().size() < most) return false;
  }
  return false;
}

// Less bad elements may be in the way of the worst one. If they were not, more of this work improves nothing.
bool is_left(Search& search, double quality) {
  const std::optional<WaitingElement> worst = search.worst();
  return worst && worst->quality >= quality;
}

// The polyhedron of a point that may be removed.
std::optional<Polyhedron> place_of(Search& search, Vertex p) {
  if (!search.mesh().in_mesh(p)) return std::nullopt;
  std::vector<Tet> tets;
  ball(search.mesh(), p, tets);
  if (tets.size() > tuning::kMostFilledBall) return std::nullopt;
  Polyhedron place(search, std::move(tets), tuning::kFilledAnew.front());
  if (place.points() == 0) return std::nullopt;
  return place;
}

// Points that recovery leaves hardly ever go afterwards, and a point that stands for an element is one that
// was to go.
ToFill with_fewer_points(const Polyhedron& place) {
  return place.with({.most_recovered = place.points() - 1, .may_be_added = false});
}

std::vector<ToFill> places_of(Search& search, std::span<const Vertex> points, std::size_t most) {
  std::vector<ToFill> likely;
  for (auto p = points.begin(); p != points.end() && likely.size() < most; ++p)
    if (const auto place = place_of(search, *p)) likely.push_back(with_fewer_points(*place));
  return likely;
}

// `limit` is the worst Q allowed in the polyhedron of the removed point.
bool fill_anew_without_point(Search& search, const Polyhedron& place, const Filler& fill, double limit,
                             const LikelyToFill& likely) {
  const std::optional<Filling> filling = fill(with_fewer_points(place), likely);
  search.poll();
  if (!filling || !place.is_filled_by(*filling) || place.worst(*filling) > std::max(limit, place.worst()))
    return false;
  Search::Trial trial(search, Search::Trial::Agenda::set_aside);
  if (const auto added = place.replace(*filling)) {
    search.add_points(*added);
    search.forget(trial.before().changed());
    if (search.points_in_mesh() < trial.points()) {
      ++search.stats().removed;
      ++search.stats().changed;
      return true;
    }
  }
  trial.take_back();
  return false;
}

}  // namespace

void fill_anew_without_points(Search& search, const FillAnew& how) {
  const std::vector<Vertex> points = search.points();
  if (points.empty()) return;
  const double limit = search.worst_without_point();
  int vain = 0;
  for (std::size_t k = 0; k < points.size() && vain < tuning::kPointsInVain; ++k) {
    if (!search.mesh().in_mesh(points[k])) continue;
    const std::optional<Polyhedron> place = place_of(search, points[k]);
    const auto likely = [&](std::size_t most) {
      return places_of(search, std::span(points).subspan(k + 1), most);
    };
    vain = place && fill_anew_without_point(search, *place, how.fill, limit, likely) ? 0 : vain + 1;
  }
}

void fill_anew_round_the_worst(Search& search, const FillAnew& how) {
  const auto bad_from = [&](double targets) {
    return std::max(tuning::kLeastFilledAnew, targets * search.target());
  };
  double worth_it = bad_from(how.from_target), left = 0;
  LeftOut left_out;
  int vain = 0;
  for (int k = 0; k < tuning::kMostFilledAnew && vain < tuning::kFilledAnewInVain; ++k) {
    const std::optional<WaitingElement> worst = search.worst(left_out);
    if (!worst || worst->quality < worth_it) return;
    worth_it = bad_from(tuning::kFilledAnewForTarget);
    if (!fill_anew_round(search, *worst, how.fill, left_out, worth_it)) {
      ++vain;
      left = std::max(left, worst->quality);
    } else if (vain > 0 && is_left(search, left)) {
      return;
    }
  }
}

}  // namespace holdfast
