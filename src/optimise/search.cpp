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

std::vector<Vertex> free_vertices(const TetMesh& mesh, const std::vector<Tet>& tets, Vertex first_free) {
  std::vector<Vertex> points;
  for (const Tet t : tets)
    for (const Vertex v : mesh.corners(t))
      if (v >= first_free) points.push_back(v);
  sort_unique(points);
  return points;
}

// The slots of tetrahedra other than those to be improved.
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
      threads_(threads),
      is_others_(slots_of_others(mesh, tets)),
      qualities_(mesh),
      elements_(mesh, qualities_, first_free, target, seed, Budget(tets.size()), monitor),
      log_(mesh) {
  elements_.points() = free_vertices(mesh, tets, first_free);
}

void Search::move_points() {
  std::vector<Tet> changed;
  for (const Vertex p : points())
    if (!budget().is_half_spent() && elements_.ways().move(p, budget(), changed)) ++stats().relocated;
  stats().changed += changed.size();
}

std::size_t Search::points_in_mesh() const {
  return static_cast<std::size_t>(
      std::count_if(points().begin(), points().end(), [&](Vertex p) { return mesh_.in_mesh(p); }));
}

Badness Search::badness() {
  Badness all;
  std::mutex mutex;
  qualities_.make_room();
  parallel_ranges(threads_, mesh_.slot_count(), [&](std::size_t first, std::size_t last) {
    Badness own;
    for (auto t = static_cast<Tet>(first); t < last; ++t)
      if (mesh_.alive(t) && is_ours(t)) own.add(qualities_.of(t), bad_from());
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
      elements_.good(), [this](Tet other) { return is_ours(other); }, is_left_out, threads_);
  if (t == kNone) return std::nullopt;
  return WaitingElement{qualities_.of(t), t, mesh_.corners(t)};
}

Search::Trial::Trial(Search& search, Agenda agenda)
    : search_(search),
      mark_(search.log_.mark()),
      agenda_(agenda == Agenda::kept ? search.agenda() : search.agenda().set_aside()),
      budget_(search.budget()),
      stats_(search.stats()),
      points_(search.points().size()),
      points_in_mesh_(search.points_in_mesh()) {}

void Search::Trial::improve_what_changed() {
  const std::vector<Tet> changed = before().changed();
  search_.forget(changed);
  search_.push(changed);
  search_.budget().fix(tuning::kShakeWork);
  search_.work_off(Ways::Points::none);
}

bool Search::Trial::has_paid() const {
  const TetMesh& mesh = search_.mesh_;
  const BadFrom& bad_from = search_.bad_from();
  const UndoLog::Before was_there = before();
  Badness was, is;
  // Everything that has changed belongs to our regions, whatever slots the search began with.
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
  search_.agenda() = std::move(agenda_);
  search_.budget() = budget_;
  search_.stats() = stats_;
  ++search_.stats().changed;
  search_.elements_.points().resize(points_);
}

}  // namespace holdfast
