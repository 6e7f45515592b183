#include "recover/insert_vertex.h"

#include <vector>

#include "mesh/editor.h"
#include "mesh/traverse.h"

namespace holdfast {
namespace {

int side_of_face(const TetMesh& mesh, Face f, Vertex v) {
  const auto corners = mesh.face_vertices(f);
  return mesh.orient(corners[0], corners[1], corners[2], v);
}

// The tetrahedron that contains the vertex, or all at the face or edge that contains it; none on the hull.
std::vector<Tet> all_that_hold(TetMesh& mesh, Vertex v, Tet t) {
  std::vector<Tet> tets{t};
  mesh.mark_visited(t);
  bool is_inside = true;
  for (std::size_t k = 0; k < tets.size() && is_inside; ++k)
    for (int i = 0; i < 4; ++i) {
      const Face f = face_code(tets[k], i);
      const Tet next = tet_of(mesh.neighbour(f));
      if ((mesh.flags(next) & kVisited) != 0 || side_of_face(mesh, f, v) != 0) continue;
      if (mesh.is_ghost(next)) {
        is_inside = false;
        break;
      }
      mesh.mark_visited(next);
      tets.push_back(next);
    }
  for (const Tet s : tets) mesh.clear_visited(s);
  if (!is_inside) tets.clear();
  return tets;
}

}  // namespace

bool insert_vertex(TetMesh& mesh, Vertex v, std::uint32_t& random) {
  Tet start = 0;
  while (start < mesh.slot_count() && (!mesh.alive(start) || mesh.is_ghost(start))) ++start;
  if (start == mesh.slot_count()) return false;
  const Tet t = walk_to(mesh, v, start, random);
  if (t == kNone || mesh.is_ghost(t)) return false;
  const std::vector<Tet> holders = all_that_hold(mesh, v, t);
  if (holders.empty()) return false;
  std::vector<TetMesh::Corners> cone;
  for (const Tet s : holders)
    for (int i = 0; i < 4; ++i) {
      const Face f = face_code(s, i);
      if (side_of_face(mesh, f, v) == 0) continue;
      const auto c = mesh.face_vertices(f);
      cone.push_back({c[0], c[1], c[2], v});
    }
  MeshEditor(mesh).replace({.old_tets = holders, .new_tets = cone});
  return true;
}

}  // namespace holdfast
