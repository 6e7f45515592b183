#include "optimise/contract.h"

#include <algorithm>
#include <numeric>

#include "optimise/tuning.h"

namespace holdfast {

std::span<const Tet> VertexContractor::contract(Vertex v, double longest) {
  const bool is_small = contraction_.turn_to(v);
  work_ = static_cast<double>(contraction_.ball().size());
  if (!is_small) return {};
  const std::span<const Vertex> link = contraction_.link();
  work_ *= static_cast<double>(link.size());
  const double most = contraction_.longest();
  if (most > longest) longest = tuning::kLongerContracted * most;
  double best = volume_.energy(contraction_.ball());
  for (const Vertex w : link) {
    const double after = energy_with(w, longest, best);
    if (!is_less(after, best) || !contraction_.is_valid()) continue;
    best = after;
    contraction_.choose();
  }
  if (!contraction_.has_choice() || !contraction_.is_allowed()) return {};
  return contraction_.make();
}

// The energy of the ball with w instead of its vertex; infinite, or at least `limit`, if the contraction
// does not pay or an edge would be too long.
double VertexContractor::energy_with(Vertex w, double longest, double limit) {
  const std::span<const TetMesh::Corners> tets = contraction_.with(w);
  if (tets.empty() || !contraction_.is_within(longest, w)) return kNoEnergy;
  double sum = 0;
  for (std::size_t k = 0; k < tets.size() && sum < limit; k += 4) {
    const std::size_t count = std::min<std::size_t>(4, tets.size() - k);
    const std::array<double, 4> energies = volume_.energies_of(tets.subspan(k, count));
    sum = std::accumulate(energies.begin(), energies.begin() + static_cast<std::ptrdiff_t>(count), sum);
  }
  return sum;
}

}  // namespace holdfast
