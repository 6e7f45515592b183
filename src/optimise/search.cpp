#include "optimise/search.h"

#include <algorithm>
#include <mutex>
#include <tuple>

#include "mesh/quality.h"
#include "mesh/traverse.h"
#include "numbers/sorted.h"
#include "optimise/tuning.h"

namespace holdfast {
namespace {

BadFrom bad_from(double target) {
  const double hopeless = std::max(tuning::kHopeless, tuning::kHopelessForTarget * target);
  return {std::max(tuning::kFlat, tuning::kFlatForTarget * target), hopeless,
          std::max(tuning::kNull, hopeless)};
}

std::vector<Vertex> free_vertices(const TetMesh& mesh, const std::vector<Tet>& tets, Vertex first_free) {
  std::vector<Vertex> points;
  for (const Tet t : tets)
    for (const Vertex v : mesh.corners(t))
      if (v >= first_free) points.push_back(v);
  sort_unique(points);
  return points;
}

// The slots that hold other tetrahedra than those that are to be better.
std::vector<bool> slots_of_others(const TetMesh& mesh, const std::vector<Tet>& tets) {
  std::vector<bool> others(mesh.slot_count());
  for (Tet t = 0; t < mesh.slot_count(); ++t) others[t] = mesh.alive(t);
  for (const Tet t : tets) others[t] = false;
  return others;
}

double quality_before(const UndoLog::Before& before, Tet t) {
  const TetMesh::Corners& c = before.corners(t);
  return quality(before.position(c[0]), before.position(c[1]), before.position(c[2]), before.position(c[3]));
}

}  // namespace

Search::Search(TetMesh& mesh, const std::vector<Tet>& tets, Vertex first_free, double target,
               std::uint64_t seed, const Threads& threads, Monitor& monitor)
    : mesh_(mesh),
      target_(target),
      good_(std::max(tuning::kGood, target)),
      bad_from_(holdfast::bad_from(target)),
      monitor_(monitor),
      threads_(threads),
      is_others_(slots_of_others(mesh, tets)),
      qualities_(mesh),
      ways_(mesh, qualities_, first_free, bad_from_, seed),
      log_(mesh),
      budget_(tets.size()),
      points_(free_vertices(mesh, tets, first_free)) {}

void Search::move_points() {
  std::vector<Tet> changed;
  for (const Vertex p : points_)
    if (!budget_.is_half_spent() && ways_.move(p, budget_, changed)) ++stats_.relocated;
  stats_.changed += changed.size();
}

void Search::push_all(std::span<const Tet> tets) {
  qualities_.compute(tets, threads_);
  push(tets);
}

void Search::push(std::span<const Tet> tets) {
  for (const Tet t : tets) {
    if (mesh_.alive(t)) push(t);
    monitor_.poll(Stage::optimise, budget_.fraction());
  }
}

void Search::push(Tet t) {
  const double q = qualities_.of(t);
  if (q > good_) agenda_.push({q, t, mesh_.corners(t)});
}

bool Search::is_current(const WaitingElement& e) {
  return mesh_.alive(e.tet) && mesh_.corners(e.tet) == e.corners && qualities_.of(e.tet) == e.quality;
}

void Search::work_off(Ways::Points points) {
  const auto is_spent = [&](const WaitingElement& e) {
    if (e.quality < tuning::kBad && agenda_.has_failed_often()) return true;
    return budget_.is_spent(e.quality >= bad_from_.hopeless, e.quality >= agenda_.worst_stuck());
  };
  while (agenda_.has_next() && !is_spent(agenda_.next())) {
    const WaitingElement worst = agenda_.take();
    if (is_current(worst)) improve(worst, points);
    agenda_.try_flat_again(bad_from_.flat, [this](const WaitingElement& e) { return is_current(e); });
  }
}

void Search::improve(const WaitingElement& e, Ways::Points points) {
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
  // What did not help may have changed something, too.
  stats_.changed += changed.size();
  qualities_.forget(changed);
  push(changed);
}

std::size_t Search::points_in_mesh() const {
  return static_cast<std::size_t>(
      std::count_if(points_.begin(), points_.end(), [&](Vertex p) { return mesh_.in_mesh(p); }));
}

Badness Search::badness() const {
  Badness all;
  std::mutex mutex;
  parallel_ranges(threads_, mesh_.slot_count(), [&](std::size_t first, std::size_t last) {
    Badness own;
    for (auto t = static_cast<Tet>(first); t < last; ++t)
      if (mesh_.alive(t) && is_ours(t)) own.add(quality_of(mesh_, mesh_.corners(t)), bad_from_);
    const std::scoped_lock lock(mutex);
    all = join(all, own);
  });
  return all;
}

std::optional<WaitingElement> Search::worst(std::span<const TetMesh::Corners> left_out) {
  const auto is_left_out = [&](Tet t) {
    return std::find(left_out.begin(), left_out.end(), mesh_.corners(t)) != left_out.end();
  };
  const Tet t = qualities_.worst(
      good_, [this](Tet other) { return is_ours(other); }, is_left_out, threads_);
  if (t == kNone) return std::nullopt;
  return WaitingElement{qualities_.of(t), t, mesh_.corners(t)};
}

Search::Trial::Trial(Search& search, Agenda agenda)
    : search_(search),
      mark_(search.log_.mark()),
      agenda_(agenda == Agenda::kept ? search.agenda_ : search.agenda_.set_aside()),
      budget_(search.budget_),
      stats_(search.stats_),
      points_(search.points_.size()),
      points_in_mesh_(search.points_in_mesh()) {}

bool Search::Trial::has_paid() const {
  const TetMesh& mesh = search_.mesh_;
  const BadFrom& bad_from = search_.bad_from_;
  const UndoLog::Before was_there = before();
  Badness was, is;
  // All that has changed is of our regions, whichever slots of them the search began with.
  for (const Tet t : was_there.changed()) {
    if (was_there.existed(t) && was_there.alive(t)) was.add(quality_before(was_there, t), bad_from);
    if (mesh.alive(t)) is.add(quality_of(mesh, mesh.corners(t)), bad_from);
  }
  return std::tuple(is.null, is.hopeless, is.worst) <
         std::tuple(was.null, was.hopeless, tuning::kLeastGain * was.worst);
}

void Search::Trial::take_back() {
  TetMesh& mesh = search_.mesh_;
  const UndoLog::Before was = before();
  const std::vector<Tet> touched = was.touched();
  const std::vector<Vertex> moved = was.moved();
  search_.log_.undo(mark_);
  search_.forget(touched);
  std::vector<Tet> tets;
  for (const Vertex v : moved)
    if (v < mesh.vertex_count() && mesh.in_mesh(v)) ball(mesh, v, tets);
  search_.forget(tets);
  search_.agenda_ = std::move(agenda_);
  search_.budget_ = budget_;
  search_.stats_ = stats_;
  ++search_.stats_.changed;
  search_.points_.resize(points_);
}

}  // namespace holdfast
