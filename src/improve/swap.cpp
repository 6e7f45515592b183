#include "improve/swap.h"

#include "optimise/tuning.h"

namespace holdfast {

LeastEnergy::LeastEnergy(const ImprovedVolume& volume, double most)
    : ExchangesInMesh(volume.mesh(), tuning::kMostShellForEnergy), volume_(volume), most_(most) {}

std::span<const Tet> EnergySwapper::improve(Tet t, bool as_worst) {
  LeastEnergy objective(volume_, as_worst ? volume_.energy(t) : kNoEnergy);
  const Exchange* const best = search_.best_at(t, objective);
  if (best == nullptr) return {};
  return volume_.replace(best->old_tets, best->new_tets);
}

}  // namespace holdfast
