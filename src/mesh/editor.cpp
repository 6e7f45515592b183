#include "mesh/editor.h"

#include "mesh/traverse.h"

namespace holdfast {

void MeshEditor::throw_on_fault_round(Vertex v) {
  std::vector<Tet> tets;
  ball(mesh_, v, tets);
  finish(tets);
}

}  // namespace holdfast
