#include "optimise/walking.h"

#include <algorithm>
#include <array>

#include "mesh/quality.h"
#include "mesh/traverse.h"
#include "numbers/vector.h"
#include "optimise/random_exchange.h"
#include "optimise/reconnect.h"
#include "optimise/tuning.h"

namespace holdfast {
namespace {

constexpr double kWorthWalking = 10, kWorthWalkingForTarget = 3;
constexpr double kLeastWalkGain = 0.8;
constexpr int kMostWalks = 40, kWalksInVain = 4;
constexpr int kWalkSteps = 150, kWalkStepsASearch = 16;
constexpr std::size_t kMostWalkedBall = 500, kMostWalkWander = 4;

// Whether some vertex makes an element on face f whose Q is below `limit`: unless one does, no exchange
// betters the element at a facet. It need not see the facet.
bool has_better_apex(const TetMesh& mesh, Face f, double limit) {
  const std::array<Vertex, 3> v = mesh.face_vertices(f);
  const Point &a = mesh.position(v[0]), &b = mesh.position(v[1]), &c = mesh.position(v[2]);
  const Vector u = b - a, w = c - a, normal = cross(u, w);
  const double area = length(normal), longest = std::max({length(u), length(w), length(c - b)});
  const double side = dot(mesh.position(mesh.apex(f)) - a, normal) > 0 ? 1 : -1;
  // Of an element of height h the inradius is below h / 2.
  const double least = kQualityOfRegular * 2 * longest / limit * area;
  for (Vertex p = 0; p < mesh.vertex_count(); ++p) {
    const Point& x = mesh.position(p);
    if (side * dot(x - a, normal) > least && quality(a, b, c, x) < limit) return true;
  }
  return false;
}

bool may_be_better(const TetMesh& mesh, const WaitingElement& e) {
  for (int i = 0; i < 4; ++i) {
    const Face f = face_code(e.tet, i);
    if (mesh.is_facet(f) && !has_better_apex(mesh, f, kLeastWalkGain * e.quality)) return false;
  }
  return true;
}

class Walk {
 public:
  Walk(Search& search, const WaitingElement& from)
      : search_(search),
        mesh_(search.mesh()),
        from_(from),
        limit_(tuning::kLeastGain * from.quality),
        step_(mesh_),
        // The one that has to go is compared with its own Q, whatever counts as flat.
        none_is_flat_{std::numeric_limits<double>::infinity()} {}

  /// Returns whether the element is gone.
  bool run() {
    int made = 0;
    for (int k = 0; k < kWalkSteps; ++k) {
      if (!step()) continue;
      ++made;
      if (is_gone() || exchange_it()) return true;
      if (made % kWalkStepsASearch == 0 && reconnect_it()) return true;
    }
    return false;
  }

 private:
  bool is_gone() const { return !mesh_.alive(from_.tet) || mesh_.corners(from_.tet) != from_.corners; }

  bool step() {
    tets_.clear();
    ball(mesh_, from_.corners[search_.random()() % 4], tets_);
    if (tets_.size() > kMostWalkedBall) return false;
    const Tet t = wander(tets_[search_.random()() % tets_.size()]);
    if (!search_.is_ours(t) || mesh_.is_ghost(t)) return false;
    if (is_same(t)) return false;
    return step_.exchange(t, limit_, search_.random(), created_);
  }

  bool is_same(Tet t) const { return t == from_.tet; }

  Tet wander(Tet t) {
    for (std::size_t steps = search_.random()() % kMostWalkWander; steps > 0; --steps) {
      const Face f = face_code(t, static_cast<int>(search_.random()() % 4));
      const Tet next = tet_of(mesh_.neighbour(f));
      if (!mesh_.is_facet(f) && !mesh_.is_ghost(next)) t = next;
    }
    return t;
  }

  bool exchange_it() { return step_.exchange(from_.tet, limit_, search_.random(), created_); }

  bool reconnect_it() {
    return reconnect(mesh_, from_.tet, search_.first_free(), none_is_flat_, false, search_.random(), created_);
  }

  Search& search_;
  TetMesh& mesh_;
  const WaitingElement from_;
  const double limit_;
  RandomExchanger step_;
  const BadFrom none_is_flat_;
  std::vector<Tet> tets_, created_;
};

bool walk_and_improve(Search& search, const WaitingElement& worst, const Search::Trial& trial) {
  if (!Walk(search, worst).run()) return false;
  const std::vector<Tet> changed = trial.before().changed();
  search.forget(changed);
  search.push(changed);
  search.budget().fix(tuning::kShakeWork);
  search.work_off(Ways::Points::none);
  return true;
}

}  // namespace

void walk_from_the_worst(Search& search) {
  const double worth_walking = std::max(kWorthWalking, kWorthWalkingForTarget * search.target());
  int vain = 0;
  for (int k = 0; k < kMostWalks && vain < kWalksInVain; ++k) {
    std::vector<WaitingElement>& stuck = search.agenda().stuck();
    std::erase_if(stuck, [&](const WaitingElement& e) { return !search.is_current(e); });
    if (stuck.empty()) return;
    const WaitingElement worst = *std::max_element(stuck.begin(), stuck.end());
    if (worst.quality < worth_walking || !may_be_better(search.mesh(), worst)) return;
    Search::Trial trial(search, Search::Trial::Agenda::set_aside);
    if (walk_and_improve(search, worst, trial) && trial.has_paid()) {
      ++search.stats().changed;
      vain = 0;
      continue;
    }
    ++vain;
    trial.take_back();
  }
}

}  // namespace holdfast
