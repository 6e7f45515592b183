#include "mesh/edge_removal.h"

namespace holdfast {

bool gather_shell(const TetMesh& mesh, Tet t, Vertex a, Vertex b, EdgeShell& out, std::size_t most) {
  out.a = a;
  out.b = b;
  out.tets.clear();
  out.link.clear();
  const Tet start = t;
  do {
    if (out.tets.size() == most || mesh.is_ghost(t)) return false;
    const auto& cd = kOpposite[static_cast<std::size_t>(mesh.index_of(t, a))]
                              [static_cast<std::size_t>(mesh.index_of(t, b))];
    out.tets.push_back(t);
    out.link.push_back(mesh.corner(t, cd[0]));
    t = tet_of(mesh.neighbour(t, cd[0]));
  } while (t != start);
  return true;
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
