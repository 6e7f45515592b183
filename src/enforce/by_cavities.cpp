#include "enforce/by_cavities.h"

#include <optional>

#include "enforce/tuning.h"
#include "mesh/editor.h"
#include "mesh/kernel.h"
#include "mesh/traverse.h"

namespace holdfast {
namespace {

// Moves v out of the facet's plane, to above the facet. The part of v's kernel above the facet is not empty:
// v lies in the closure of that part, and on no plane of it except the facet's.
void leave_plane(TetMesh& mesh, Vertex v, const Triangle& facet) {
  if (mesh.orient(facet[0], facet[1], facet[2], v) != 0) return;
  std::vector<Tet> tets;
  ball(mesh, v, tets);
  Kernel above = kernel_of_ball(mesh, v, tets);
  above.add(facet[0], facet[1], facet[2]);
  if (const std::optional<Position> place = above.find(mesh.point(v)))
    MeshEditor(mesh).move_vertex(v, *place);
}

}  // namespace

bool recover_by_cavities(TetMesh& mesh, FacetCavities& cavities, const Triangle& facet,
                         SteinerPoints& steiner, const std::function<void()>& tell,
                         const FacetCavities::Finish& finish) {
  for (int tries = 0; !cavities.recover(facet, tell, finish); ++tries) {
    std::vector<Vertex> in_the_way = cavities.in_the_way();
    steiner.keep_added(in_the_way);
    if (tries == tuning::kCavityTries || in_the_way.empty()) return false;
    if (tries == 0) steiner.settle(in_the_way);  // some may be removed; the others move a little
    for (const Vertex v : in_the_way)
      if (mesh.in_mesh(v)) leave_plane(mesh, v, facet);
  }
  steiner.add(cavities.added());
  steiner.settle_new();
  steiner.settle_all_now_and_then();
  return true;
}

}  // namespace holdfast
