#include "suppress/fill_cavity.h"

#include <algorithm>

#include "mesh/editor.h"

namespace holdfast {

Kernel kernel_of(const TetMesh& mesh, const Cavity& cavity) {
  Kernel kernel(mesh);
  for (const auto& f : cavity.faces()) kernel.add(f[0], f[1], f[2]);
  return kernel;
}

std::vector<TetMesh::Corners> cone_of(std::span<const std::array<Vertex, 3>> faces, Vertex apex) {
  std::vector<TetMesh::Corners> tets;
  for (const auto& f : faces)
    if (std::find(f.begin(), f.end(), apex) == f.end()) tets.push_back({f[0], f[1], f[2], apex});
  return tets;
}

bool fill(TetMesh& mesh, const Cavity& cavity, const PolyhedronOptions& search, std::vector<Tet>* created) {
  const auto fresh = fill_polyhedron(mesh, cavity.faces(), search);
  if (!fresh) return false;
  const std::vector<Vertex> inner = cavity.inner();
  MeshEditor(mesh).replace({.old_tets = cavity.tets(), .new_tets = *fresh}, created);
  for (const Vertex v : inner) MeshEditor(mesh).remove_vertex(v);
  return true;
}

void cone(TetMesh& mesh, const Cavity& cavity, Vertex apex, std::vector<Tet>* created,
          const std::optional<Point>& place) {
  const std::vector<Vertex> inner = cavity.inner();
  const std::vector<TetMesh::Corners> fresh = cone_of(cavity.faces(), apex);
  Replacement replacement{.old_tets = cavity.tets(), .new_tets = fresh};
  if (place) replacement.move = {apex, *place};
  MeshEditor(mesh).replace(replacement, created);
  for (const Vertex v : inner)
    if (v != apex) MeshEditor(mesh).remove_vertex(v);
}

}  // namespace holdfast
