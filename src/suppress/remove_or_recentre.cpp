#include "suppress/remove_or_recentre.h"

#include "mesh/editor.h"
#include "mesh/kernel.h"
#include "mesh/measure.h"
#include "mesh/traverse.h"
#include "suppress/fill_cavity.h"

namespace holdfast {

Fate remove_or_recentre(TetMesh& mesh, Vertex p, const PolyhedronOptions& search) {
  std::vector<Tet> tets;
  ball(mesh, p, tets);
  const Kernel kernel = kernel_of_ball(mesh, p, tets);
  const auto refill = [&](const std::vector<TetMesh::Corners>& fresh) {
    MeshEditor(mesh).replace({.old_tets = tets, .new_tets = fresh});
    MeshEditor(mesh).remove_vertex(p);
  };
  if (const Vertex apex = best_apex(mesh, kernel); apex != kNone) {
    refill(cone_of(kernel.faces(), apex));
    return Fate::collapsed;
  }
  if (const auto fresh = fill_polyhedron(mesh, kernel.faces(), search)) {
    refill(*fresh);
    return Fate::filled;
  }
  const auto position = kernel.find(mesh.point(p));
  if (!position) return Fate::stays;
  MeshEditor(mesh).move_vertex(p, *position);
  return Fate::moved;
}

}  // namespace holdfast
