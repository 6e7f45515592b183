#include "optimise/ways_for_energy.h"

#include <array>

#include "optimise/tuning.h"

namespace holdfast {

EnergyWays::EnergyWays(ImprovedVolume& volume, double very_bad)
    : volume_(volume),
      very_bad_(very_bad),
      smoother_(volume),
      swapper_(volume),
      contractor_(volume),
      adder_(volume),
      refiller_(volume) {}

struct EnergyWays::Way {
  void (EnergyWays::*attempt)(Tet, Outcome&, double&);
  std::size_t ImproveStats::*count;
  Patience least;
};

// One of sixty contractions helps on CAD parts with the surface's sizes, and one of eight exchanges and
// points. If the given size is far below the triangles', contractions remove points that obstruct others.
EnergyWays::Outcome EnergyWays::try_all(Tet t, Patience patience, double& work) {
  static constexpr std::array<Way, 5> kWays{
      {{&EnergyWays::swap, &ImproveStats::swapped, Patience::usual},
       {&EnergyWays::smooth_a_corner, &ImproveStats::moved, Patience::usual},
       {&EnergyWays::contract_a_corner, &ImproveStats::contracted, Patience::contractions},
       {&EnergyWays::add_point, &ImproveStats::inserted, Patience::usual},
       {&EnergyWays::refill, &ImproveStats::swapped, Patience::all_ways}}};
  Outcome out;
  work += 1;
  volume_.turn_to(t);
  for (const Way& way : kWays) {
    if (patience < way.least) continue;
    out.count = way.count;
    (this->*way.attempt)(t, out, work);
    if (!out.changed.empty()) return out;
  }
  return out;
}

void EnergyWays::swap(Tet t, Outcome& out, double&) { out.changed = swapper_.improve(t); }

void EnergyWays::smooth_a_corner(Tet t, Outcome& out, double& work) {
  const TetMesh::Corners corners = volume_.mesh().corners(t);
  for (const Vertex v : corners) {
    if (!volume_.may_move(v) || volume_.in_vain().has(v, InVain::AtVertex::smoothing)) continue;
    const bool moved = smoother_.smooth(v, true);
    work += static_cast<double>(smoother_.ball().size()) / tuning::kSmoothTetsAWork;
    if (!moved) {
      volume_.in_vain().add(v, InVain::AtVertex::smoothing);
      continue;
    }
    out.changed = smoother_.ball();
    return;
  }
}

void EnergyWays::contract_a_corner(Tet t, Outcome& out, double& work) {
  if (!is_very_bad(t)) return;
  const TetMesh::Corners corners = volume_.mesh().corners(t);
  for (const Vertex v : corners) {
    if (!volume_.may_move(v) || volume_.in_vain().has(v, InVain::AtVertex::contraction)) continue;
    out.changed = contractor_.contract(v, tuning::kLongestContracted * volume_.size(v));
    work += contractor_.work() / tuning::kContractTetsAWork;
    if (!out.changed.empty()) return;
    volume_.in_vain().add(v, InVain::AtVertex::contraction);
  }
}

void EnergyWays::add_point(Tet t, Outcome& out, double& work) {
  const double energy = volume_.energy(t);
  if (!may_add_ || !(energy > volume_.energy_of_sine(tuning::kSineWorthAPoint))) return;
  const bool is_added = adder_.add(t, is_very_bad(t));
  work += tuning::kAddWork + adder_.work() / tuning::kAddTetsAWork;
  if (is_added) out.changed = adder_.ball();
}

void EnergyWays::refill(Tet t, Outcome& out, double& work) {
  if (!is_very_bad(t)) return;
  work += tuning::kRefillWork;
  out.changed = refiller_.refill(t, may_add_);
  if (refiller_.point() != kNone) out.count = &ImproveStats::inserted;
}

}  // namespace holdfast
