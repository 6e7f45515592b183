#include "optimise/random_exchange.h"

#include <algorithm>

#include "mesh/quality_below.h"
#include "optimise/tuning.h"

namespace holdfast {

AnyExchange::AnyExchange(const TetMesh& mesh, double bad_from, std::mt19937_64& random)
    : ExchangesInMesh(mesh, tuning::kMostShellForQ), bad_from_(bad_from), random_(random) {}

std::optional<double> AnyExchange::after(const std::array<TetMesh::Corners, 3>& three, double) const {
  const auto is_bad = [&](const TetMesh::Corners& c) {
    return mesh_.orient(c[0], c[1], c[2], c[3]) <= 0 ||
           !is_quality_below(mesh_.position(c[0]), mesh_.position(c[1]), mesh_.position(c[2]),
                             mesh_.position(c[3]), bad_from_);
  };
  return std::any_of(three.begin(), three.end(), is_bad) ? std::nullopt : std::optional<double>(0);
}

bool RandomExchanger::exchange(Tet t, double bad_from, std::mt19937_64& random, std::vector<Tet>& created) {
  AnyExchange objective(mesh_, bad_from, random);
  const Exchange* const any = search_.best_at(t, objective);
  if (any != nullptr) make(mesh_, *any, created);
  return any != nullptr;
}

}  // namespace holdfast
