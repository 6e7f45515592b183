#include "mesh/exchange.h"

#include "mesh/editor.h"

namespace holdfast {

void make(TetMesh& mesh, const Exchange& exchange, std::vector<Tet>& created) {
  if (exchange.removes_edge)
    MeshEditor(mesh).replace_shell(exchange.shell, exchange.triangles, &created);
  else
    MeshEditor(mesh).replace({.old_tets = exchange.old_tets, .new_tets = exchange.new_tets}, &created);
}

}  // namespace holdfast
