#include "improve/add_point.h"

#include <algorithm>

namespace holdfast {

Vertex PointAdder::add(Tet& t, bool patient) {
  const TetMesh& mesh = volume_.mesh();
  const TetMesh::Corners corners = mesh.corners(t);
  tet_ = t;
  work_ = 0;
  for (int edge = 0; edge < 6; ++edge) {
    const auto& ends = kEdgeVertex[static_cast<std::size_t>(edge)];
    const Vertex a = corners[static_cast<std::size_t>(ends[0])],
                 b = corners[static_cast<std::size_t>(ends[1])];
    for (const bool by_sphere : {false, true}) {
      if (by_sphere && !patient) continue;
      const int k = kEdgeOf[static_cast<std::size_t>(mesh.index_of(tet_, a))]
                           [static_cast<std::size_t>(mesh.index_of(tet_, b))];
      if (mesh.is_segment(tet_, k) || !gather_shell(mesh, tet_, a, b, shell_)) continue;
      const Vertex p = add_at(middle_of_shell(), by_sphere ? std::span<const Tet>{} : shell_.tets);
      if (p != kNone) return p;
    }
  }
  t = tet_;
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

// In the cavity of these tetrahedra, or, without any, in the one that the in-sphere test gives.
Vertex PointAdder::add_at(const Point& place, std::span<const Tet> tets) {
  constexpr std::size_t kMostTets = 200;
  TetMesh& mesh = volume_.mesh();
  const RegionId region = volume_.region_of(tet_);
  const TetMesh::Corners bad = mesh.corners(tet_);
  const Vertex p = mesh.add_vertex(place);
  const Tet base = cavity_.locate(p, tet_);
  const bool found = base != kNone && !mesh.is_ghost(base) && volume_.region_of(base) == region &&
                     (tets.empty() ? cavity_.find(p, base, kMostTets)
                                   : std::find(tets.begin(), tets.end(), base) != tets.end() &&
                                         cavity_.find_among(p, base, tets));
  work_ += static_cast<double>(cavity_.work());
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
  ball_ = smoother_.ball();
  if (is_less(volume_.energy(ball_), before)) return p;
  take_back(bad);
  return kNone;
}

// Which may give the bad element another slot.
void PointAdder::take_back(const TetMesh::Corners& bad) {
  TetMesh& mesh = volume_.mesh();
  for (const Tet t : volume_.replace(ball_, old_))
    if (mesh.corners(t) == bad) tet_ = t;
  mesh.remove_last_vertex();
}

}  // namespace holdfast
