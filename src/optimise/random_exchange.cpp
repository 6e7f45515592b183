#include "optimise/random_exchange.h"

#include <algorithm>

#include "optimise/tuning.h"

namespace holdfast {

AnyExchange::AnyExchange(const TetMesh& mesh, double bad_from, std::mt19937_64& random)
    : ExchangesInMesh(mesh, tuning::kMostShellForQ), bad_from_(bad_from), random_(random) {}

std::optional<double> AnyExchange::after(const std::array<TetMesh::Corners, 3>& three, double) const {
  double worst = 0;
  for (const TetMesh::Corners& c : three) {
    if (mesh_.orient(c[0], c[1], c[2], c[3]) <= 0) return std::nullopt;
    worst = std::max(worst, quality_of(mesh_, c));
    if (!(worst < bad_from_)) return std::nullopt;
  }
  return worst;
}

bool RandomExchanger::exchange(Tet t, double bad_from, std::mt19937_64& random, std::vector<Tet>& created) {
  AnyExchange objective(mesh_, bad_from, random);
  const Exchange* const any = search_.best_at(t, objective);
  if (any != nullptr) make(mesh_, *any, created);
  return any != nullptr;
}

}  // namespace holdfast
