#include "improve/smooth.h"

#include <algorithm>
#include <cmath>

#include "mesh/traverse.h"

namespace holdfast {

bool VertexSmoother::smooth(Vertex v, bool patient) {
  tets_.clear();
  holdfast::ball(volume_.mesh(), v, tets_);
  if (tets_.size() > kMostBall) return false;
  gather_star(v);
  const double before = volume_.energy(tets_);
  star_.start_at(volume_.mesh().position(v), before);
  star_.step_to_ideal_place();
  if (patient) star_.descend();
  if (!is_less(star_.energy(), before) || (patient && star_.energy() > 0.997 * before)) return false;
  return settle(v);
}

// Faces whose tetrahedra are bad have more to say.
void VertexSmoother::gather_star(Vertex v) {
  const TetMesh& mesh = volume_.mesh();
  star_.clear();
  for (const Tet t : tets_) {
    const auto f = mesh.face_vertices(face_code(t, mesh.index_of(t, v)));
    star_.add(mesh.position(f[0]), mesh.position(f[1]), mesh.position(f[2]),
              std::sqrt(std::sqrt(volume_.energy(t))));
  }
}

// Makes the move if the exact signs agree.
bool VertexSmoother::settle(Vertex v) {
  TetMesh& mesh = volume_.mesh();
  const Point old = mesh.position(v);
  mesh.move_vertex(v, star_.at());
  const auto is_positive = [&](Tet t) { return volume_.is_positive(mesh.corners(t)); };
  if (!std::all_of(tets_.begin(), tets_.end(), is_positive)) {
    mesh.move_vertex(v, old);
    return false;
  }
  star_.for_each_energy([&](std::size_t k, double e) { volume_.note(tets_[k], e); });
  return true;
}

}  // namespace holdfast
