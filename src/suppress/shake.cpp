#include "suppress/shake.h"

#include <vector>

#include "mesh/traverse.h"

namespace holdfast {
namespace {

// Some steps from t across faces that are no facets.
Tet wander(const TetMesh& mesh, Tet t, std::mt19937_64& random) {
  constexpr std::size_t kMostSteps = 4;
  for (std::size_t steps = random() % kMostSteps; steps > 0; --steps) {
    const Face f = face_code(t, static_cast<int>(random() % 4));
    const Tet next = tet_of(mesh.neighbour(f));
    if (!mesh.is_facet(f) && !mesh.is_ghost(next)) t = next;
  }
  return t;
}

}  // namespace

void shake(TetMesh& mesh, Flipper& flipper, Vertex p, int edges, std::mt19937_64& random) {
  constexpr int kDepth = 1;
  constexpr std::size_t kBudget = 200;
  std::vector<Tet> tets;
  for (; edges > 0; --edges) {
    tets.clear();
    ball(mesh, p, tets);
    const Tet t = wander(mesh, tets[random() % tets.size()], random);
    const auto& ends = kEdgeVertex[random() % 6];
    flipper.remove(t, mesh.corner(t, ends[0]), mesh.corner(t, ends[1]), kDepth, kBudget);
  }
}

}  // namespace holdfast
