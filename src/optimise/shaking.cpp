#include "optimise/shaking.h"

#include <algorithm>

#include "mesh/traverse.h"
#include "optimise/tuning.h"
#include "suppress/refill.h"
#include "suppress/shake.h"

namespace holdfast {
namespace {

void shake_and_improve(Search& search, const WaitingElement& worst, Search::Trial& trial) {
  Flipper flipper(search.mesh(), search.random());
  shake(
      search.mesh(), flipper, worst.corners, tuning::kShakenEdges, [&](Tet t) { return search.is_ours(t); },
      search.random());
  trial.improve_what_changed();
}

// One or two points remove a hopeless element. So unless there are null elements, the worst Q improves at
// most by about the factor by which it is worse than hopeless.
bool may_points_be_worth_it(const Search& search, const Badness& was) {
  const double factor = std::max(tuning::kLeastPointGain, was.worst / search.bad_from().hopeless);
  return was.null > 0 || static_cast<double>(was.hopeless) <= tuning::kCuredByOnePoint * factor;
}

// Points pay if as many null elements are gone, or if the worst Q gets better by a factor of their number,
// and of at least ten.
bool are_points_worth_it(Search& search, const Search::Trial& trial, const Badness& was) {
  const auto more = static_cast<double>(search.points_in_mesh()) - static_cast<double>(trial.points());
  const Badness is = search.badness();
  return more <= static_cast<double>(was.null) - static_cast<double>(is.null) ||
         std::max(tuning::kLeastPointGain, more) * is.worst <= was.worst;
}

}  // namespace

void shake_the_worst(Search& search) {
  const std::size_t slots = std::max<std::size_t>(1, search.mesh().slot_count());
  const std::size_t most = std::min(tuning::kMostShakes, tuning::kMostShakenSlots / slots);
  int vain = 0;
  for (std::size_t k = 0; k < most; ++k) {
    std::vector<WaitingElement>& stuck = search.agenda().stuck();
    std::erase_if(stuck, [&](const WaitingElement& e) { return !search.is_current(e); });
    if (stuck.empty()) return;
    const WaitingElement worst = *std::max_element(stuck.begin(), stuck.end());
    const bool is_flat = worst.quality >= search.bad_from().flat;
    if (worst.quality < tuning::kBad ||
        vain >= (is_flat ? tuning::kShakesInVainForFlat : tuning::kShakesInVain))
      return;
    Search::Trial trial(search, Search::Trial::Agenda::set_aside);
    shake_and_improve(search, worst, trial);
    if (trial.has_paid()) {
      ++search.stats().changed;
      vain = 0;
      continue;
    }
    ++vain;
    trial.take_back();
  }
}

bool try_with_points(Search& search) {
  const Badness without = search.badness();
  if (without.hopeless == 0 || !may_points_be_worth_it(search, without)) return false;
  Search::Trial trial(search, Search::Trial::Agenda::kept);
  search.agenda().try_all_again([&](const WaitingElement& e) { return search.is_current(e); });
  search.budget().begin_again();
  search.work_off(Ways::Points::now);
  shake_the_worst(search);
  if (are_points_worth_it(search, trial, without)) return true;
  trial.take_back();
  return false;
}

void remove_points(Search& search, std::size_t from) {
  const std::vector<Vertex>& points = search.points();
  if (from == points.size()) return;
  TetMesh& mesh = search.mesh();
  const double limit = search.worst_without_point();
  Growth growth{.attempts = tuning::kWithoutPoint.attempts,
                .steps = tuning::kWithoutPoint.steps,
                .search = {.most_vertices = tuning::kWithoutPoint.most_vertices,
                           .most_nodes = tuning::kWithoutPoint.most_nodes}};
  const std::size_t most_work = search.budget().end_with(tuning::kLeastWork);
  const std::size_t removed_before = search.stats().removed;
  for (std::size_t k = from; k < points.size(); ++k) {
    const Vertex p = points[k];
    if (!mesh.in_mesh(p)) continue;
    if (search.budget().spent() > most_work) break;
    search.budget().spend(tuning::kRemoveWork);
    std::vector<Tet> tets;
    ball(mesh, p, tets);
    growth.search.worst_quality = std::max(limit, badness_of(mesh, tets, search.bad_from()).worst);
    if (!refill_without(mesh, p, search.first_free(), growth, search.random())) continue;
    ++search.stats().removed;
    ++search.stats().changed;
  }
  // Cavities grow, so there is no list of new elements.
  if (search.stats().removed > removed_before) search.forget_all();
}

}  // namespace holdfast
