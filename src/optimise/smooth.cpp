#include "optimise/smooth.h"

#include <algorithm>
#include <cmath>

#include "mesh/editor.h"
#include "mesh/traverse.h"
#include "optimise/tuning.h"

namespace holdfast {

bool VertexSmoother::smooth(Vertex v, bool patient) {
  tets_.clear();
  holdfast::ball(volume_.mesh(), v, tets_);
  if (tets_.size() > tuning::kMostMovedBall) return false;
  volume_.turn_to(tets_.front());
  gather_star(v);
  const double before = volume_.energy(tets_);
  if (frame_.is_plain())
    star_.start_at(volume_.mesh().position(v), before);
  else
    star_.start_at(frame_.to(volume_.mesh().position(v)));
  const double from = star_.energy();
  star_.step_to_ideal_place();
  if (patient) star_.descend();
  if (!is_less(star_.energy(), from) || (patient && star_.energy() > tuning::kLeastPatientGain * from))
    return false;
  return settle(v, before);
}

// Faces with bad tetrahedra get more weight.
void VertexSmoother::gather_star(Vertex v) {
  const TetMesh& mesh = volume_.mesh();
  star_.clear();
  frame_ = volume_.frame_of({&v, 1});
  star_.follow(volume_.rule_in(frame_));
  for (const Tet t : tets_) {
    const auto f = mesh.face_vertices(face_code(t, mesh.index_of(t, v)));
    star_.add(frame_.to(mesh.position(f[0])), frame_.to(mesh.position(f[1])), frame_.to(mesh.position(f[2])),
              std::sqrt(std::sqrt(volume_.energy(t))));
  }
}

// Makes the move if the exact signs allow it.
bool VertexSmoother::settle(Vertex v, double before) {
  TetMesh& mesh = volume_.mesh();
  const auto is_positive = [&](Tet t) { return volume_.is_positive(mesh.corners(t)); };
  const Figures old = volume_.has_standard() ? volume_.figures(tets_) : Figures{};
  if (!MeshEditor(mesh).move_if(v, frame_.from(star_.at()), tets_, [&] {
        return std::all_of(tets_.begin(), tets_.end(), is_positive) &&
               (frame_.is_plain() || is_better(before)) && volume_.allows(old, tets_);
      }))
    return false;
  if (frame_.is_plain())
    star_.for_each_energy([&](std::size_t k, double e) { volume_.note(tets_[k], e); });
  else
    for (std::size_t k = 0; k < tets_.size(); ++k) volume_.note(tets_[k], energies_[k]);
  return true;
}

// Computes the energies after the move. In a frame, the star has one metric for all elements, so its energies
// only approximate theirs.
bool VertexSmoother::is_better(double before) {
  energies_.resize(tets_.size());
  double after = 0;
  for (std::size_t k = 0; k < tets_.size(); ++k)
    after += energies_[k] = volume_.energy_of(volume_.mesh().corners(tets_[k]));
  return is_less(after, before);
}

}  // namespace holdfast
