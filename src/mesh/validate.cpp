#include "mesh/validate.h"

#include <algorithm>
#include <stdexcept>

#include "mesh/keys.h"
#include "mesh/traverse.h"

namespace holdfast {
namespace {

std::string say(Tet t, const char* what) { return "tetrahedron " + std::to_string(t) + ": " + what; }

bool same_face(const TetMesh& mesh, Face f, Face g) {
  return face_key(mesh.face_vertices(f)) == face_key(mesh.face_vertices(g));
}

bool has_repeated_corner(const TetMesh::Corners& c) {
  return c[0] == c[1] || c[0] == c[2] || c[0] == c[3] || c[1] == c[2] || c[1] == c[3] || c[2] == c[3];
}

}  // namespace

std::string find_fault(const TetMesh& mesh, Tet t) {
  if (!mesh.alive(t)) return say(t, "is dead");
  const TetMesh::Corners& c = mesh.corners(t);
  if (has_repeated_corner(c)) return say(t, "names a vertex twice");
  for (int i = 0; i < (mesh.is_ghost(t) ? 3 : 4); ++i)
    if (c[static_cast<std::size_t>(i)] >= mesh.vertex_count()) return say(t, "names no vertex");
  if (!mesh.is_ghost(t) && mesh.orient(c[0], c[1], c[2], c[3]) <= 0) return say(t, "is not positive");
  if ((mesh.flags(t) & kVisited) != 0) return say(t, "was left visited");
  for (int i = 0; i < 4; ++i) {
    const Face f = face_code(t, i);
    const Face g = mesh.neighbour(f);
    if (g == kNone || tet_of(g) >= mesh.slot_count() || !mesh.alive(tet_of(g)))
      return say(t, "lacks a neighbour");
    if (mesh.neighbour(g) != f) return say(t, "is not its neighbour's neighbour");
    if (!same_face(mesh, f, g)) return say(t, "shares no face with its neighbour");
    if (mesh.is_facet(f) != mesh.is_facet(g)) return say(t, "has a facet bit on one side only");
  }
  for (const Vertex v : c)
    if (v != kGhost && (mesh.incident(v) == kNone || !mesh.alive(mesh.incident(v)) ||
                        mesh.index_of(mesh.incident(v), v) < 0))
      return say(t, "has a vertex without an incident tetrahedron");
  return {};
}

std::string find_fault(const TetMesh& mesh) {
  std::vector<Tet> ring;
  for (Tet t = 0; t < mesh.slot_count(); ++t) {
    if (!mesh.alive(t)) continue;
    if (std::string fault = find_fault(mesh, t); !fault.empty()) return fault;
    for (int k = 0; k < 6; ++k) {
      if (!mesh.is_segment(t, k)) continue;
      const auto [a, b] = ends_of_edge(mesh.corners(t), k);
      ring.clear();
      shell(mesh, t, a, b, ring);
      for (const Tet s : ring)
        if (!mesh.is_segment(s, mesh.edge_of(s, a, b)))
          return say(t, "has a segment bit that its shell lacks");
    }
  }
  return {};
}

void throw_on_fault(const TetMesh& mesh, std::span<const Tet> tets) {
  for (const Tet t : tets)
    if (const std::string fault = find_fault(mesh, t); !fault.empty())
      throw std::logic_error("holdfast: " + fault);
}

void throw_on_fault(const TetMesh& mesh) {
  if (const std::string fault = find_fault(mesh); !fault.empty())
    throw std::logic_error("holdfast: " + fault);
}

}  // namespace holdfast
