#include "improve/add_point.h"

#include <algorithm>

#include "mesh/traverse.h"

namespace holdfast {

Vertex PointAdder::add(Tet& t, bool patient) {
  const TetMesh& mesh = volume_.mesh();
  const TetMesh::Corners corners = mesh.corners(t);
  for (int edge = 0; edge < 6; ++edge) {
    const auto& ends = kEdgeVertex[static_cast<std::size_t>(edge)];
    const Vertex a = corners[static_cast<std::size_t>(ends[0])],
                 b = corners[static_cast<std::size_t>(ends[1])];
    for (const bool by_sphere : {false, true}) {
      if (by_sphere && !patient) continue;
      const int k = kEdgeOf[static_cast<std::size_t>(mesh.index_of(t, a))]
                           [static_cast<std::size_t>(mesh.index_of(t, b))];
      if (mesh.is_segment(t, k) || !gather_shell(mesh, t, a, b, shell_)) continue;
      const Vertex p =
          by_sphere ? add_at(middle_of_shell(), t, {}) : add_at(middle_of_shell(), t, shell_.tets);
      if (p != kNone) return p;
      t = find_again(t, corners);
    }
  }
  return kNone;
}

Point PointAdder::middle_of_shell() const {
  const TetMesh& mesh = volume_.mesh();
  Point middle{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (const Vertex v : shell_.link) middle[k] += mesh.position(v)[k];
    middle[k] = (middle[k] + mesh.position(shell_.a)[k] + mesh.position(shell_.b)[k]) /
                static_cast<double>(shell_.link.size() + 2);
  }
  return middle;
}

// A failed attempt is taken back, which may give the tetrahedron another slot.
Tet PointAdder::find_again(Tet t, const TetMesh::Corners& c) {
  TetMesh& mesh = volume_.mesh();
  if (mesh.alive(t) && mesh.corners(t) == c) return t;
  const Face f = find_face(mesh, c[0], c[1], c[2]);
  return mesh.index_of(tet_of(f), c[3]) >= 0 ? tet_of(f) : tet_of(mesh.neighbour(f));
}

// In the cavity of these tetrahedra, or, without any, in the one that the in-sphere test gives.
Vertex PointAdder::add_at(const Point& place, Tet start, std::span<const Tet> tets) {
  TetMesh& mesh = volume_.mesh();
  const RegionId region = volume_.region_of(start);
  const Vertex p = mesh.add_vertex(place);
  const Tet base = cavity_.locate(p, start);
  const bool found = base != kNone && !mesh.is_ghost(base) && volume_.region_of(base) == region &&
                     (tets.empty() ? cavity_.find(p, base)
                                   : std::find(tets.begin(), tets.end(), base) != tets.end() &&
                                         cavity_.find_among(p, base, tets));
  if (!found) {
    mesh.remove_last_vertex();
    return kNone;
  }
  old_.clear();
  for (const Tet t : cavity_.tets()) old_.push_back(mesh.corners(t));
  const double before = volume_.energy(cavity_.tets());
  cavity_.insert();
  volume_.adopt(cavity_.created(), region);
  smoother_.smooth(p, true);
  ball_.clear();
  holdfast::ball(mesh, p, ball_);
  if (is_less(volume_.energy(ball_), before)) return p;
  volume_.replace(ball_, old_);
  mesh.remove_last_vertex();
  return kNone;
}

}  // namespace holdfast
