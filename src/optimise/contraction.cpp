#include "optimise/contraction.h"

#include <algorithm>
#include <limits>

#include "mesh/editor.h"
#include "mesh/traverse.h"
#include "numbers/sorted.h"
#include "optimise/tuning.h"

namespace holdfast {

bool Contraction::turn_to(Vertex v) {
  v_ = v;
  chosen_.clear();
  link_.clear();
  ball_.clear();
  holdfast::ball(volume_.mesh(), v, ball_);
  if (ball_.size() > tuning::kMostContractedBall) return false;
  members_.clear();
  faces_.clear();
  for (const Tet t : ball_) {
    const TetMesh::Corners& c = volume_.mesh().corners(t);
    const auto at = static_cast<std::size_t>(std::find(c.begin(), c.end(), v) - c.begin());
    members_.push_back({c, at});
    faces_.push_back({c[(at + 1) % 4], c[(at + 2) % 4], c[(at + 3) % 4]});
  }
  link_ = corners_of_all(faces_);
  return true;
}

std::span<const TetMesh::Corners> Contraction::with(Vertex w) {
  candidate_.resize(members_.size());
  const auto is_w = [w](Vertex x) { return static_cast<std::size_t>(x == w); };
  std::size_t count = 0;  // of those without w; branchless, because the choice is unpredictable
  for (const Member& m : members_) {
    const TetMesh::Corners& c = m.corners;
    candidate_[count] = c;
    candidate_[count][m.index] = w;
    count += 1 - (is_w(c[0]) + is_w(c[1]) + is_w(c[2]) + is_w(c[3]));
  }
  candidate_.resize(count);
  return candidate_;
}

double Contraction::longest() const {
  double most = 0;
  for (const Vertex w : link_) most = std::max(most, volume_.length(v_, w));
  return most;
}

bool Contraction::is_within(double longest, Vertex w) const {
  if (longest == std::numeric_limits<double>::infinity()) return true;
  return std::all_of(candidate_.begin(), candidate_.end(), [&](const TetMesh::Corners& c) {
    return std::all_of(c.begin(), c.end(),
                       [&](Vertex x) { return x == w || volume_.length(x, w) <= longest; });
  });
}

bool Contraction::is_valid() const {
  return !candidate_.empty() &&
         std::all_of(candidate_.begin(), candidate_.end(),
                     [&](const TetMesh::Corners& c) { return volume_.is_positive(c); });
}

std::span<const Tet> Contraction::make() {
  const auto created = volume_.replace(ball_, chosen_);
  MeshEditor(volume_.mesh()).remove_vertex(v_);
  return created;
}

}  // namespace holdfast
