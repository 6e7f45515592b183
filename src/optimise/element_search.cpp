#include "optimise/element_search.h"

#include <algorithm>
#include <optional>

#include "optimise/tuning.h"

namespace holdfast {
namespace {

BadFrom bad_from(double target) {
  const double hopeless = std::max(tuning::kHopeless, tuning::kHopelessForTarget * target);
  return {std::max(tuning::kFlat, tuning::kFlatForTarget * target), hopeless,
          std::max(tuning::kNull, hopeless)};
}

}  // namespace

ElementSearch::ElementSearch(TetMesh& mesh, Qualities& qualities, Vertex first_free, double target,
                             std::uint64_t seed, const Budget& budget, Monitor& monitor)
    : mesh_(mesh),
      qualities_(qualities),
      good_(std::max(tuning::kGood, target)),
      bad_from_(holdfast::bad_from(target)),
      monitor_(monitor),
      ways_(mesh, qualities, first_free, bad_from_, seed),
      agenda_(bad_from_.flat),
      budget_(budget) {}

void ElementSearch::push(std::span<const Tet> tets) {
  for (const Tet t : tets) {
    if (mesh_.alive(t)) push(t);
    monitor_.poll(Stage::optimise, budget_.fraction());
  }
}

void ElementSearch::push(Tet t) {
  const double q = qualities_.of(t);
  if (q > good_) agenda_.push({q, t, mesh_.corners(t)});
}

bool ElementSearch::is_current(const WaitingElement& e) {
  return mesh_.alive(e.tet) && mesh_.corners(e.tet) == e.corners && qualities_.of(e.tet) == e.quality;
}

void ElementSearch::work_off(Ways::Points points, const std::function<bool()>& may_go_on) {
  const auto corners_of = [this](double quality, Tet t) -> std::optional<TetMesh::Corners> {
    if (!mesh_.alive(t) || qualities_.of(t) != quality) return std::nullopt;
    return mesh_.corners(t);
  };
  const auto is_spent = [&](const WaitingElement& e) {
    if (e.quality < tuning::kBad && agenda_.has_failed_often()) return true;
    return budget_.is_spent(e.quality >= bad_from_.hopeless, e.quality >= agenda_.worst_stuck());
  };
  while (agenda_.has_next(corners_of) && !is_spent(agenda_.next()) && (!may_go_on || may_go_on())) {
    const WaitingElement worst = agenda_.take();
    if (is_current(worst)) improve(worst, points);
    agenda_.try_flat_again(bad_from_.flat, [this](const WaitingElement& e) { return is_current(e); });
  }
}

std::size_t ElementSearch::work_off_null(const std::function<bool()>& may_go_on) {
  const std::vector<WaitingElement>& stuck = agenda_.stuck();
  const auto is_null = [&](const WaitingElement& e) { return e.quality >= bad_from_.null && is_current(e); };
  if (std::none_of(stuck.begin(), stuck.end(), is_null)) return 0;
  agenda_.try_again_from(bad_from_.null, [this](const WaitingElement& e) { return is_current(e); });
  budget_.begin_again();
  work_off(Ways::Points::for_null, may_go_on);
  return budget_.spent();
}

void ElementSearch::improve(const WaitingElement& e, Ways::Points points) {
  monitor_.poll(Stage::optimise, budget_.fraction());
  std::vector<Tet> changed;
  Ways::Attempt attempt{e, agenda_.worst_stuck(), points, budget_, changed};
  if (std::size_t OptimiseStats::*const way = ways_.try_all(attempt)) {
    ++(stats_.*way);
    budget_.note_gain();
  } else {
    agenda_.give_up(e);
  }
  if (attempt.added != kNone) points_.push_back(attempt.added);
  // Attempts without success may have changed something, too.
  stats_.changed += changed.size();
  qualities_.forget(changed);
  push(changed);
}

}  // namespace holdfast
