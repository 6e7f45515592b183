#include "improve/swap.h"

namespace holdfast {
namespace {

constexpr std::size_t kMostShell = 9;  // larger shells hardly ever pay, and cost their cube

}  // namespace

std::span<const Tet> EnergySwapper::improve(Tet t, bool as_worst) {
  gain_ = 0;
  most_ = as_worst ? volume_.energy(t) : kNoEnergy;
  old_.clear();
  for (int edge = 0; edge < 6; ++edge) try_edge(t, edge);
  for (int side = 0; side < 4; ++side) try_face(face_code(t, side));
  if (old_.empty()) return {};
  return volume_.replace(old_, fresh_);
}

std::optional<double> EnergySwapper::Objective::triangle(std::size_t i, std::size_t k, std::size_t j) const {
  const Vertex pi = shell.link[i], pk = shell.link[k], pj = shell.link[j];
  const Pair e = volume.energies_of({pi, pk, pj, shell.b}, {pj, pk, pi, shell.a});
  const double both = e[0] + e[1];
  if (!(both < before)) return std::nullopt;
  return both;
}

void EnergySwapper::try_edge(Tet t, int edge) {
  const TetMesh& mesh = volume_.mesh();
  // A facet round the edge would have it for a side, so only segments are in the way.
  if (mesh.is_segment(t, edge)) return;
  const auto& ends = kEdgeVertex[static_cast<std::size_t>(edge)];
  if (!gather_shell(mesh, t, mesh.corner(t, ends[0]), mesh.corner(t, ends[1]), shell_, kMostShell)) return;
  double before = 0;
  for (const Tet s : shell_.tets) {
    if (volume_.energy(s) > most_) return;
    before += volume_.energy(s);
  }
  if (before <= gain_) return;
  Objective objective{volume_, shell_, before};
  const std::optional<double> after = triangulation_.find(shell_.size(), objective);
  if (!after || !is_less(*after, before) || before - *after <= gain_) return;
  triangles_.clear();
  candidate_.clear();
  triangulation_.triangles(shell_.size(), triangles_);
  tetrahedra_of(shell_, triangles_, candidate_);
  offer(before, *after, shell_.tets);
}

void EnergySwapper::try_face(Face f) {
  const TetMesh& mesh = volume_.mesh();
  const Face g = mesh.neighbour(f);
  if (mesh.is_facet(f) || mesh.is_ghost(tet_of(g))) return;
  const std::array<Tet, 2> both{tet_of(f), tet_of(g)};
  const double before = volume_.energy(both);
  if (before <= gain_ || volume_.energy(both[1]) > most_) return;
  const std::array<Vertex, 3> v = mesh.face_vertices(f);  // seen positively from the apex of f
  const Vertex top = mesh.apex(f), bottom = mesh.apex(g);
  candidate_.clear();
  for (std::size_t k = 0; k < 3; ++k) candidate_.push_back({bottom, v[k], v[(k + 1) % 3], top});
  const Pair e = volume_.energies_of(candidate_[0], candidate_[1]);
  double after = e[0] + e[1];
  if (!(after < before)) return;
  after += volume_.energy_of(candidate_[2]);
  if (is_less(after, before)) offer(before, after, both);
}

void EnergySwapper::offer(double before, double after, std::span<const Tet> old_tets) {
  if (before - after <= gain_) return;
  for (const TetMesh::Corners& c : candidate_)
    if (!volume_.is_positive(c)) return;
  gain_ = before - after;
  fresh_.swap(candidate_);
  old_.assign(old_tets.begin(), old_tets.end());
}

}  // namespace holdfast
