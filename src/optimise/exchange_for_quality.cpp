#include "optimise/exchange_for_quality.h"

#include <cmath>

#include "optimise/tuning.h"

namespace holdfast {

LeastBadness::LeastBadness(const TetMesh& mesh, Qualities& qualities, const BadFrom& bad_from)
    : ExchangesInMesh(mesh, tuning::kMostShellForQ), qualities_(qualities), bad_from_(bad_from) {}

LeastBadness::Link LeastBadness::link(const EdgeShell& shell, const Badness& before) const {
  return {mesh_, shell, before, bad_from_};
}

std::optional<Badness> LeastBadness::Link::triangle(std::size_t i, std::size_t k, std::size_t j) const {
  const Vertex pi = shell_.link[i], pk = shell_.link[k], pj = shell_.link[j];
  // For flat elements, the signs cost less than the exact quality.
  if (!sees_both_ends(mesh_, shell_, i, k, j)) return std::nullopt;
  Badness both;
  both.add(quality_of(mesh_, {pi, pk, pj, shell_.b}), bad_from_);
  if (!both.is_worthwhile_after(before_)) return std::nullopt;
  both.add(quality_of(mesh_, {pj, pk, pi, shell_.a}), bad_from_);
  if (!both.is_worthwhile_after(before_)) return std::nullopt;
  return both;
}

std::optional<Badness> LeastBadness::after(const std::array<TetMesh::Corners, 3>& three,
                                           const Badness& before) const {
  Badness sum;
  for (const TetMesh::Corners& c : three) {
    if (mesh_.orient(c[0], c[1], c[2], c[3]) <= 0) return std::nullopt;
    sum.add(quality_of(mesh_, c), bad_from_);
    if (!sum.is_worthwhile_after(before)) return std::nullopt;
  }
  return sum;
}

LeastBadness::Gain LeastBadness::gain_of(const Badness& before, const Badness& after) {
  const auto fewer = [](std::size_t x, std::size_t y) {
    return static_cast<std::ptrdiff_t>(y) - static_cast<std::ptrdiff_t>(x);
  };
  return {fewer(before.null, after.null), fewer(before.hopeless, after.hopeless),
          fewer(before.flat, after.flat), std::isinf(before.worst) ? 0 : after.worst / before.worst};
}

bool Exchanger::improve(Tet t, std::vector<Tet>& created) {
  LeastBadness objective(mesh_, qualities_, bad_from_);
  const Exchange* const best = search_.best_at(t, objective);
  if (best != nullptr) make(mesh_, *best, created);
  return best != nullptr;
}

}  // namespace holdfast
