#include "optimise/ways_for_quality.h"

#include <algorithm>
#include <array>

#include "mesh/traverse.h"
#include "optimise/insert_point.h"
#include "optimise/reconnect.h"
#include "optimise/relocate.h"
#include "optimise/tuning.h"

namespace holdfast {

struct Ways::Way {
  bool (Ways::*attempt)(Attempt&);
  std::size_t OptimiseStats::*count;
};

std::size_t OptimiseStats::*Ways::try_all(Attempt& attempt) {
  static constexpr std::array<Way, 6> kWays{{{&Ways::exchange, &OptimiseStats::exchanged},
                                             {&Ways::move_a_corner, &OptimiseStats::relocated},
                                             {&Ways::remove_flat, &OptimiseStats::unflattened},
                                             {&Ways::reconnect_round, &OptimiseStats::reconnected},
                                             {&Ways::reconnect_patiently, &OptimiseStats::reconnected},
                                             {&Ways::insert, &OptimiseStats::inserted}}};
  for (const Way& way : kWays)
    if ((this->*way.attempt)(attempt)) return way.count;
  return nullptr;
}

bool Ways::exchange(Attempt& attempt) {
  attempt.budget.spend(1);
  return exchanger_.improve(attempt.element.tet, attempt.changed);
}

bool Ways::move_a_corner(Attempt& attempt) {
  const TetMesh::Corners corners = mesh_.corners(attempt.element.tet);
  return std::any_of(corners.begin(), corners.end(), [&](Vertex p) {
    if (p < first_free_ || (held_ != nullptr && (*held_)[p] != 0)) return false;
    return move(p, attempt.budget, attempt.changed);
  });
}

bool Ways::move(Vertex p, Budget& budget, std::vector<Tet>& changed) {
  std::vector<Tet> tets;
  ball(mesh_, p, tets);
  if (tets.size() > tuning::kMostMovedBall) return false;
  budget.spend(tets.size() / 2);
  if (!relocate(mesh_, p, tets, random_)) return false;
  changed.insert(changed.end(), tets.begin(), tets.end());
  return true;
}

// An element that is not flat matters here only as the worst of all.
bool Ways::remove_flat(Attempt& attempt) {
  const WaitingElement& e = attempt.element;
  if (e.quality < std::min(bad_from_.flat, attempt.worst_stuck)) return false;
  const bool removed = flat_remover_.remove(e.tet, bad_from_.limit_for(e.quality), attempt.changed);
  attempt.budget.spend(flat_remover_.work());
  return removed;
}

bool Ways::reconnect_round(Attempt& attempt) {
  if (!is_worth_reconnecting(attempt)) return false;
  attempt.budget.spend(tuning::kReconnectWork);
  const bool reconnected =
      reconnect(mesh_, attempt.element.tet, first_free_, bad_from_, false, random_, attempt.changed);
  reconnections_in_vain_ = reconnected ? 0 : reconnections_in_vain_ + 1;
  return reconnected;
}

// A search is long and seldom finds anything: as long as it does so now and then, but always for what would
// better the worst of all, or else gets a point now.
bool Ways::is_worth_reconnecting(const Attempt& attempt) const {
  const WaitingElement& e = attempt.element;
  if (attempt.points != Points::later && (e.quality >= attempt.worst_stuck || is_worth_a_point(attempt)))
    return true;
  return reconnections_in_vain_ < (e.quality >= tuning::kWorthReconnecting
                                       ? tuning::kReconnectionsInVainForFlat
                                       : tuning::kReconnectionsInVain);
}

// A point that would come next is worth some milliseconds, a few times.
bool Ways::reconnect_patiently(Attempt& attempt) {
  if (!may_get_a_point(attempt)) return false;
  if (++patient_ > tuning::kMostPatient) return false;
  attempt.budget.spend(tuning::kPatientWork);
  return reconnect(mesh_, attempt.element.tet, first_free_, bad_from_, true, random_, attempt.changed);
}

bool Ways::may_get_a_point(const Attempt& attempt) const {
  if (spare_ != nullptr && spare_->empty()) return false;
  return attempt.points == Points::now        ? attempt.element.quality >= bad_from_.hopeless
         : attempt.points == Points::for_null ? attempt.element.quality >= bad_from_.null
                                              : false;
}

// As long as a worse one stays, a point would not better the mesh's worst; but null elements are of no use
// to anyone.
bool Ways::is_worth_a_point(const Attempt& attempt) const {
  return attempt.element.quality >=
         std::max(bad_from_.hopeless, std::min(attempt.worst_stuck, bad_from_.null));
}

bool Ways::insert(Attempt& attempt) {
  if (!may_get_a_point(attempt) || !is_worth_a_point(attempt)) return false;
  attempt.budget.spend(tuning::kInsertWork);
  const double most = attempt.element.quality < bad_from_.null ? bad_from_.hopeless : bad_from_.null;
  attempt.added = insert_point(mesh_, attempt.element.tet, first_free_, most, spare_, attempt.changed);
  if (attempt.added == kNone) return false;
  move(attempt.added, attempt.budget, attempt.changed);
  return true;
}

}  // namespace holdfast
