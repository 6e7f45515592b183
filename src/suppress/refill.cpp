#include "suppress/refill.h"

#include <vector>

#include "mesh/replace.h"
#include "mesh/traverse.h"
#include "suppress/cavity.h"

namespace holdfast {

bool refill_without(TetMesh& mesh, Vertex p, const Growth& growth, std::mt19937_64& random) {
  std::vector<Tet> tets;
  ball(mesh, p, tets);
  for (int attempt = 0; attempt < growth.attempts; ++attempt) {
    Cavity cavity(mesh, tets);
    for (int step = 0; step < growth.steps; ++step) {
      if (!cavity.grow(random) || cavity.vertex_count() > growth.search.most_vertices) break;
      if (const auto fresh = fill_polyhedron(mesh, cavity.faces(), growth.search)) {
        replace(mesh, {.old_tets = cavity.tets(), .new_tets = *fresh});
        mesh.remove_vertex(p);
        return true;
      }
    }
  }
  return false;
}

}  // namespace holdfast
