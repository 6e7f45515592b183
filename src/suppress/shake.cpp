#include "suppress/shake.h"

#include <vector>

#include "mesh/traverse.h"
#include "suppress/tuning.h"

namespace holdfast {
namespace {

// Walks some steps from t across faces that are not facets.
Tet wander(const TetMesh& mesh, Tet t, std::mt19937_64& random) {
  for (std::size_t steps = random() % tuning::kMostWander; steps > 0; --steps) {
    const Face f = face_code(t, static_cast<int>(random() % 4));
    const Tet next = tet_of(mesh.neighbour(f));
    if (!mesh.is_facet(f) && !mesh.is_ghost(next)) t = next;
  }
  return t;
}

// Returns whether any flip was made.
bool remove_an_edge(TetMesh& mesh, Flipper& flipper, const std::vector<Tet>& of, std::mt19937_64& random) {
  if (of.empty()) return false;
  const std::size_t before = flipper.counts().all();
  const Tet t = wander(mesh, of[random() % of.size()], random);
  const auto [a, b] = ends_of_edge(mesh.corners(t), static_cast<int>(random() % 6));
  flipper.remove(t, a, b, tuning::kShakeDepth, tuning::kShakeBudget);
  return flipper.counts().all() > before;
}

}  // namespace

void shake(TetMesh& mesh, Flipper& flipper, Vertex p, int edges, std::mt19937_64& random) {
  std::vector<Tet> tets;
  ball(mesh, p, tets);
  for (; edges > 0; --edges) {
    if (!remove_an_edge(mesh, flipper, tets, random)) continue;
    tets.clear();
    ball(mesh, p, tets);
  }
}

void shake(TetMesh& mesh, Flipper& flipper, const TetMesh::Corners& corners, int edges,
           const std::function<bool(Tet)>& may_change, std::mt19937_64& random) {
  std::vector<Tet> tets;
  for (; edges > 0; --edges) {
    tets.clear();
    ball(mesh, corners[random() % 4], tets);
    if (tets.size() > tuning::kMostShakenBall) continue;
    std::erase_if(tets, [&](Tet t) { return !may_change(t); });
    remove_an_edge(mesh, flipper, tets, random);
  }
}

}  // namespace holdfast
