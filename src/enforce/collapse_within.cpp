#include "enforce/collapse_within.h"

#include <algorithm>

#include "mesh/editor.h"
#include "mesh/kernel.h"
#include "mesh/measure.h"
#include "mesh/traverse.h"
#include "numbers/sorted.h"

namespace holdfast {
namespace {

// The facet faces at P that do not contain v, with P replaced by v.
std::vector<std::array<Vertex, 3>> moved_facets(const TetMesh& mesh, const std::vector<Tet>& tets, Vertex p,
                                                Vertex v) {
  std::vector<std::array<Vertex, 3>> facets;
  for (const Tet t : tets)
    for (int i = 0; i < 4; ++i) {
      if (mesh.corner(t, i) == p || !mesh.is_facet(face_code(t, i))) continue;
      auto f = mesh.face_vertices(face_code(t, i));
      if (std::find(f.begin(), f.end(), v) != f.end()) continue;
      std::replace(f.begin(), f.end(), p, v);
      facets.push_back(f);
    }
  return facets;
}

}  // namespace

std::vector<Vertex> facet_neighbours(TetMesh& mesh, Vertex p) {
  std::vector<Tet> tets;
  ball(mesh, p, tets);
  std::vector<Vertex> out;
  for (const Tet t : tets)
    for (int i = 0; i < 4; ++i) {
      if (mesh.corner(t, i) == p || !mesh.is_facet(face_code(t, i))) continue;
      for (const Vertex v : mesh.face_vertices(face_code(t, i)))
        if (v != p) out.push_back(v);
    }
  sort_unique(out);
  return out;
}

bool collapse_within(TetMesh& mesh, Vertex p, std::span<const Vertex> candidates,
                     std::span<const std::array<Vertex, 2>> segment) {
  std::vector<Tet> tets;
  ball(mesh, p, tets);
  const Kernel kernel = kernel_of_ball(mesh, p, tets);
  const Vertex v = best_apex(mesh, kernel, candidates);
  if (v == kNone) return false;
  std::vector<TetMesh::Corners> fresh;
  for (const auto& f : kernel.faces())
    if (f[0] != v && f[1] != v && f[2] != v) fresh.push_back({f[0], f[1], f[2], v});
  const auto facets = moved_facets(mesh, tets, p, v);
  MeshEditor(mesh).replace({.old_tets = tets, .new_tets = fresh, .facets = facets, .segments = segment});
  MeshEditor(mesh).remove_vertex(p);
  return true;
}

}  // namespace holdfast
