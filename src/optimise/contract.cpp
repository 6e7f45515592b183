#include "optimise/contract.h"

#include <algorithm>

#include "mesh/editor.h"
#include "mesh/traverse.h"
#include "numbers/sorted.h"
#include "optimise/tuning.h"

namespace holdfast {

std::span<const Tet> VertexContractor::contract(Vertex v, double longest) {
  TetMesh& mesh = volume_.mesh();
  tets_.clear();
  ball(mesh, v, tets_);
  work_ = static_cast<double>(tets_.size());
  if (tets_.size() > tuning::kMostContractedBall) return {};
  link_.clear();
  for (const Tet t : tets_)
    for (const Vertex w : mesh.corners(t))
      if (w != v) link_.push_back(w);
  sort_unique(link_);
  work_ *= static_cast<double>(link_.size());
  double most = 0;
  for (const Vertex w : link_) most = std::max(most, volume_.length(v, w));
  if (most > longest) longest = tuning::kLongerContracted * most;
  const double before = volume_.energy(tets_);
  double best = before;
  fresh_.clear();
  for (const Vertex w : link_) {
    const double after = energy_with(v, w, longest, best);
    if (!is_less(after, best)) continue;
    if (!std::all_of(candidate_.begin(), candidate_.end(),
                     [&](const TetMesh::Corners& c) { return volume_.is_positive(c); }))
      continue;
    best = after;
    fresh_.swap(candidate_);
  }
  if (fresh_.empty() || !volume_.allows(tets_, fresh_)) return {};
  const auto created = volume_.replace(tets_, fresh_);
  MeshEditor(mesh).remove_vertex(v);
  return created;
}

// The energy of the ball of v with w in its place, and the tetrahedra in candidate_; infinite, or at least
// `limit`, where that does not pay.
double VertexContractor::energy_with(Vertex v, Vertex w, double longest, double limit) {
  if (!list_with(v, w, longest) || candidate_.empty()) return kNoEnergy;
  double sum = 0;
  for (std::size_t k = 0; k + 1 < candidate_.size() && sum < limit; k += 2) {
    const Pair both = volume_.energies_of(candidate_[k], candidate_[k + 1]);
    sum += both[0] + both[1];
  }
  if (candidate_.size() % 2 == 1 && sum < limit) sum += volume_.energy_of(candidate_.back());
  return sum;
}

// The tetrahedra of the ball of v with w in its place, in candidate_; false where an edge would be too long.
bool VertexContractor::list_with(Vertex v, Vertex w, double longest) {
  const TetMesh& mesh = volume_.mesh();
  candidate_.clear();
  for (const Tet t : tets_) {
    TetMesh::Corners c = mesh.corners(t);
    if (std::find(c.begin(), c.end(), w) != c.end()) continue;
    for (Vertex& x : c) {
      if (x == v) {
        x = w;
        continue;
      }
      if (volume_.length(x, w) > longest) return false;
    }
    candidate_.push_back(c);
  }
  return true;
}

}  // namespace holdfast
