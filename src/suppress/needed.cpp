#include "suppress/needed.h"

#include <algorithm>
#include <vector>

#include "mesh/traverse.h"
#include "suppress/cavity.h"
#include "suppress/small_polyhedron.h"
#include "suppress/tuning.h"

namespace holdfast {
namespace {

// The tetrahedra that can be reached from p without crossing a facet; the search stops early if there are
// many.
std::vector<Tet> component_of(TetMesh& mesh, Vertex p) {
  std::vector<Tet> tets;
  ball(mesh, p, tets);
  for (std::size_t k = 0; k < tets.size() && tets.size() <= tuning::kMostTetsOfProof; ++k)
    for (int i = 0; i < 4; ++i) {
      const Face f = face_code(tets[k], i);
      const Tet next = tet_of(mesh.neighbour(f));
      if (!mesh.is_facet(f) && std::find(tets.begin(), tets.end(), next) == tets.end()) tets.push_back(next);
    }
  return tets;
}

// Whether the component is bounded: the outside of an open surface, with its ghosts, is not.
bool is_small_solid(const TetMesh& mesh, const std::vector<Tet>& tets) {
  return tets.size() <= tuning::kMostTetsOfProof &&
         std::none_of(tets.begin(), tets.end(), [&](Tet t) { return mesh.is_ghost(t); });
}

using Faces = std::vector<std::array<Vertex, 3>>;  // as seen from inside

// Whether only p is inside: no vertex, segment or facet that a filling would have to keep.
bool holds_only(const TetMesh& mesh, const std::vector<Tet>& tets, const Faces& boundary, Vertex p) {
  const auto is_inside = [&](Tet t) { return std::find(tets.begin(), tets.end(), t) != tets.end(); };
  return std::all_of(tets.begin(), tets.end(), [&](Tet t) {
    for (int i = 0; i < 4; ++i) {
      const Face f = face_code(t, i);
      if (mesh.corner(t, i) != p && !any_holds(boundary, mesh.corner(t, i))) return false;
      if (mesh.is_facet(f) && is_inside(tet_of(mesh.neighbour(f)))) return false;
    }
    for (int k = 0; k < 6; ++k) {
      const auto [a, b] = ends_of_edge(mesh.corners(t), k);
      if (mesh.is_segment(t, k) && !any_holds(boundary, a, b)) return false;
    }
    return true;
  });
}

}  // namespace

bool is_needed(TetMesh& mesh, Vertex p, Vertex first_free) {
  const std::vector<Tet> tets = component_of(mesh, p);
  if (!is_small_solid(mesh, tets)) return false;
  Faces boundary;
  for (const Tet t : tets)
    for (int i = 0; i < 4; ++i)
      if (mesh.is_facet(face_code(t, i))) boundary.push_back(mesh.face_vertices(face_code(t, i)));
  const bool has_steiner_points = std::any_of(boundary.begin(), boundary.end(), [&](const auto& f) {
    return std::any_of(f.begin(), f.end(), [&](Vertex v) { return v >= first_free; });
  });
  return !has_steiner_points && holds_only(mesh, tets, boundary, p) &&
         is_unfillable(mesh, boundary, tuning::kProofSearch);
}

}  // namespace holdfast
