#include "optimise/walking.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "mesh/edge_removal.h"
#include "mesh/traverse.h"
#include "optimise/forced_apex.h"
#include "optimise/random_exchange.h"
#include "optimise/reconnect.h"
#include "optimise/remove_flat.h"
#include "optimise/tuning.h"
#include "optimise/walk_tuning.h"

namespace holdfast {
namespace {

class Walk {
 public:
  Walk(Search& search, const WaitingElement& from)
      : search_(search),
        mesh_(search.mesh()),
        from_(from),
        limit_(tuning::kLeastGain * from.quality),
        exchanger_(mesh_),
        remover_(mesh_) {}

  /// Returns whether the element is gone.
  bool run() {
    int made = 0;
    for (int k = 0; k < tuning::kWalkSteps; ++k) {
      if (!step()) continue;
      ++made;
      if (is_gone() || exchanger_.exchange(from_.tet, limit_, search_.random(), created_)) return true;
      if (made % tuning::kWalkStepsARemoval == 0 && remover_.remove(from_.tet, limit_, created_)) return true;
      // Flips without success may have removed the element as well.
      if (is_gone()) return true;
      if (made % tuning::kWalkStepsASearch == 0 && reconnect_round()) return true;
    }
    return false;
  }

 private:
  [[nodiscard]] bool is_gone() const {
    return !mesh_.alive(from_.tet) || mesh_.corners(from_.tet) != from_.corners;
  }

  bool step() {
    created_.clear();
    const Tet t = search_.random()() % 100 < tuning::kPercentAtEdges ? near_an_edge() : near_a_corner();
    if (t == kNone || t == from_.tet || !search_.is_ours(t)) return false;
    return exchanger_.exchange(t, limit_, search_.random(), created_);
  }

  // One of the element's edges must be removed.
  Tet near_an_edge() {
    const auto [a, b] = ends_of_edge(from_.corners, static_cast<int>(search_.random()() % 6));
    if (!gather_shell(mesh_, from_.tet, a, b, shell_)) return kNone;
    return wander(shell_.tets, tuning::kMostSteppedFromEdge);
  }

  Tet near_a_corner() {
    tets_.clear();
    ball(mesh_, from_.corners[search_.random()() % 4], tets_);
    return tets_.size() > tuning::kMostWalkedBall ? kNone : wander(tets_, tuning::kMostSteppedFromCorner);
  }

  // Walks some steps from one of the tetrahedra across faces that are not facets.
  Tet wander(std::span<const Tet> from, std::size_t most_steps) {
    Tet t = from[search_.random()() % from.size()];
    for (std::size_t steps = search_.random()() % most_steps; steps > 0; --steps) {
      const Face f = face_code(t, static_cast<int>(search_.random()() % 4));
      const Tet next = tet_of(mesh_.neighbour(f));
      if (!mesh_.is_facet(f) && !mesh_.is_ghost(next)) t = next;
    }
    return mesh_.is_ghost(t) ? kNone : t;
  }

  // Whatever counts as flat, the element is compared with its own Q.
  bool reconnect_round() {
    const BadFrom none_is_flat{std::numeric_limits<double>::infinity()};
    return reconnect(mesh_, from_.tet, search_.first_free(), none_is_flat, false, search_.random(), created_);
  }

  Search& search_;
  TetMesh& mesh_;
  const WaitingElement from_;
  const double limit_;
  RandomExchanger exchanger_;
  FlatRemover remover_;
  EdgeShell shell_;
  std::vector<Tet> tets_, created_;
};

}  // namespace

void walk_from_the_worst(Search& search) {
  const double worth_walking =
      std::max(tuning::kWorthWalking, tuning::kWorthWalkingForTarget * search.target());
  std::optional<WaitingElement> worst;
  int vain = 0;
  for (int k = 0; k < tuning::kMostWalks && vain < tuning::kWalksInVain; ++k) {
    // An unsuccessful walk leaves the mesh unchanged.
    if (vain == 0) {
      worst = search.worst();
      if (!worst || worst->quality < worth_walking || !may_be_better(search.mesh(), *worst, search.threads()))
        return;
    }
    Search::Trial trial(search, Search::Trial::Agenda::set_aside);
    if (Walk(search, *worst).run()) {
      // Its neighbourhood may have become worse, up to the limit.
      trial.improve_what_changed();
      if (trial.has_paid()) {
        ++search.stats().changed;
        vain = 0;
        continue;
      }
    }
    ++vain;
    trial.take_back();
  }
}

}  // namespace holdfast
