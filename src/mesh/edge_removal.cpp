#include "mesh/edge_removal.h"

namespace holdfast {

bool gather_shell(const TetMesh& mesh, Tet t, Vertex a, Vertex b, EdgeShell& out, std::size_t most) {
  if (mesh.is_ghost(t)) return false;
  return gather_round(mesh, t, a, b, out, most, [&](Tet s, int i) {
    const Tet next = tet_of(mesh.neighbour(s, i));
    return mesh.is_ghost(next) ? kNone : next;
  });
}

void tetrahedra_of(const EdgeShell& shell, const std::vector<LinkTriangle>& triangles,
                   std::vector<TetMesh::Corners>& out) {
  for (const auto& [i, k, j] : triangles) {
    const Vertex pi = shell.link[i], pk = shell.link[k], pj = shell.link[j];
    out.push_back({pi, pk, pj, shell.b});
    out.push_back({pj, pk, pi, shell.a});
  }
}

}  // namespace holdfast
