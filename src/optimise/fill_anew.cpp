#include "optimise/fill_anew.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "mesh/traverse.h"
#include "optimise/forced_apex.h"
#include "optimise/polyhedron.h"
#include "optimise/tuning.h"

namespace holdfast {
namespace {

// As many points more, as many times better, and ten times at least.
bool are_points_worth_it(const Search& search, const Search::Trial& trial, double gain) {
  const std::size_t points = search.points_in_mesh();
  return points <= trial.points() ||
         gain >= std::max(tuning::kLeastPointGain, static_cast<double>(points - trial.points()));
}

bool fill_anew(Search& search, const Polyhedron& polyhedron, const Filler& fill) {
  if (!polyhedron.may_be_filled_below(polyhedron.worst() / tuning::kLeastGainOfFilling)) return false;
  const std::optional<Filling> filling = fill(polyhedron.surface(), {});
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

// What is near an element that stays is left out from then on.
bool fill_anew_round(Search& search, const WaitingElement& worst, const Filler& fill,
                     std::vector<TetMesh::Corners>& left_out) {
  left_out.push_back(worst.corners);
  if (!may_be_better(search.mesh(), worst, search.threads())) return false;
  for (const std::size_t most : tuning::kFilledAnew) {
    const Polyhedron polyhedron(search, {worst.tet}, most);
    if (fill_anew(search, polyhedron, fill)) return true;
    if (most == tuning::kFilledAnew.front())
      for (const Tet t : polyhedron.tets()) left_out.push_back(search.mesh().corners(t));
    if (polyhedron.tets().size() < most) return false;  // more would be the same: these are all there are
  }
  return false;
}

// What is less bad may be in the way of what is worst. Where it was not, more of it would better nothing.
bool is_left(Search& search, double quality) {
  const std::optional<WaitingElement> worst = search.worst();
  return worst && worst->quality >= quality;
}

// `limit` is the worst Q that the place of a point may have.
bool fill_anew_without(Search& search, Vertex p, const Filler& fill, double limit) {
  std::vector<Tet> tets;
  ball(search.mesh(), p, tets);
  if (tets.size() > tuning::kMostFilledBall) return false;
  const Polyhedron polyhedron(search, std::move(tets), tuning::kFilledAnew.front());
  // What recovery leaves hardly ever goes afterwards, and a point for an element is one that was to go.
  if (polyhedron.points() == 0) return false;
  const std::optional<Filling> filling =
      fill(polyhedron.surface(), {.most_recovered = polyhedron.points() - 1, .may_be_added = false});
  search.poll();
  if (!filling || !polyhedron.is_filled_by(*filling) ||
      polyhedron.worst(*filling) > std::max(limit, polyhedron.worst()))
    return false;
  Search::Trial trial(search, Search::Trial::Agenda::set_aside);
  if (const auto added = polyhedron.replace(*filling)) {
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
  const double limit = search.worst_without_point();
  const std::vector<Vertex> points = search.points();
  int vain = 0;
  for (const Vertex p : points) {
    if (!search.mesh().in_mesh(p)) continue;
    if (vain == tuning::kPointsInVain) return;
    vain = fill_anew_without(search, p, how.fill, limit) ? 0 : vain + 1;
  }
}

void fill_anew_round_the_worst(Search& search, const FillAnew& how) {
  const auto bad_from = [&](double targets) {
    return std::max(tuning::kLeastFilledAnew, targets * search.target());
  };
  double worth_it = bad_from(how.from_target), left = 0;
  std::vector<TetMesh::Corners> left_out;
  int vain = 0;
  for (int k = 0; k < tuning::kMostFilledAnew && vain < tuning::kFilledAnewInVain; ++k) {
    const std::optional<WaitingElement> worst = search.worst(left_out);
    if (!worst || worst->quality < worth_it) return;
    worth_it = bad_from(tuning::kFilledAnewForTarget);
    if (!fill_anew_round(search, *worst, how.fill, left_out)) {
      ++vain;
      left = std::max(left, worst->quality);
    } else if (vain > 0 && is_left(search, left)) {
      return;
    }
  }
}

}  // namespace holdfast
