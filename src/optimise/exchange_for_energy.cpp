#include "optimise/exchange_for_energy.h"

#include "optimise/tuning.h"

namespace holdfast {

LeastEnergy::LeastEnergy(const ImprovedVolume& volume, double most)
    : ExchangesInMesh(volume.mesh(), tuning::kMostShellForEnergy), volume_(volume), most_(most) {}

std::span<const Tet> EnergySwapper::improve(Tet t, bool as_worst) {
  LeastEnergy objective(volume_, as_worst ? volume_.energy(t) : kNoEnergy);
  const Exchange* const best = search_.best_at(t, objective);
  if (best == nullptr || !volume_.allows(best->old_tets, best->new_tets)) return {};
  return volume_.make(*best);
}

}  // namespace holdfast
