#include "optimise/refill.h"

#include <algorithm>

#include "mesh/editor.h"
#include "optimise/tuning.h"
#include "suppress/fill_cavity.h"

namespace holdfast {

std::span<const Tet> CavityRefiller::refill(Tet t, bool may_add) {
  best_ = {};
  may_add_ = may_add;
  point_ = kNone;
  near_ = volume_.mesh().corners(t);
  frame_ = volume_.frame_of(near_);
  Cavity cavity(volume_.mesh(), std::array{t}, volume_.first_free());
  std::size_t last = tuning::kMostRefilled;
  do {
    const double before = best_.gain;
    try_point(cavity);
    // The search measures elements in Euclidean space.
    if (frame_.is_plain() && cavity.tets().size() >= tuning::kLeastTets &&
        cavity.vertex_count() <= tuning::kMostRefillVertices)
      try_without(cavity);
    if (best_.gain > before)
      last = std::min(tuning::kMostRefilled, cavity.tets().size() + tuning::kFartherThanBest);
  } while (cavity.tets().size() < last && grow(cavity));
  return best_.gain > 0 ? apply() : std::span<const Tet>{};
}

void CavityRefiller::try_point(const Cavity& cavity) {
  find_place(cavity);
  if (may_add_ && star_.energy() < kNoEnergy) offer(cavity, volume_.energy(cavity.tets()) - star_.energy());
}

// Fills without a point; no new element may be half as bad as the worst old one.
void CavityRefiller::try_without(const Cavity& cavity) {
  const TetMesh& mesh = volume_.mesh();
  double worst = 0;
  for (const Tet t : cavity.tets()) worst = std::max(worst, volume_.energy(t));
  const auto fresh = fill_polyhedron(
      mesh, cavity.faces(),
      {.most_nodes = tuning::kRefillNodes, .worst_quality = tuning::kRefillGain * worst, .measure = energy});
  if (!fresh) return;
  double after = 0;
  for (const TetMesh::Corners& c : *fresh) after += volume_.energy_of(c);
  const double before = best_.gain;
  offer(cavity, volume_.energy(cavity.tets()) - after);
  if (best_.gain > before) best_.fresh = *fresh;
}

void CavityRefiller::offer(const Cavity& cavity, double gain) {
  const double before = volume_.energy(cavity.tets());
  if (!(gain > best_.gain) || !is_less(before - gain, before)) return;
  best_ = {.gain = gain,
           .old_tets = cavity.tets(),
           .inner = cavity.inner(),
           .faces = cavity.faces(),
           .place = frame_.from(star_.at()),
           .fresh = {}};
}

// Finds the best place for a point joined to the faces. If no place sees all faces, takes the one that is
// least far behind any of them.
void CavityRefiller::find_place(const Cavity& cavity) {
  const TetMesh& mesh = volume_.mesh();
  star_.clear();
  star_.follow(volume_.rule_in(frame_));
  Point middle{};
  for (const auto& f : cavity.faces()) {
    star_.add(frame_.to(mesh.position(f[0])), frame_.to(mesh.position(f[1])), frame_.to(mesh.position(f[2])),
              1);
    for (std::size_t k = 0; k < 3; ++k)
      for (const Vertex v : f)
        middle[k] += mesh.position(v)[k] / static_cast<double>(3 * cavity.faces().size());
  }
  heights_.clear();
  star_.start_at(frame_.to(middle));
  if (!(star_.energy() < kNoEnergy)) {
    Kernel::Centre centre = kernel_of(mesh, cavity).centre({middle.data(), nullptr});
    for (std::size_t k = 0; k < 3; ++k) middle[k] += centre.offset[k];
    star_.start_at(frame_.to(middle));
    if (!(star_.energy() < kNoEnergy)) {
      heights_ = std::move(centre.heights);
      return;
    }
  }
  star_.step_to_ideal_place();
  if (star_.energy() < tuning::kFarFromGain * volume_.energy(cavity.tets())) star_.descend();
}

// Grows the cavity across the face that is worst for the point.
bool CavityRefiller::grow(Cavity& cavity) const {
  if (!heights_.empty()) return cavity.grow_across_lowest(heights_);
  std::vector<double> order(cavity.faces().size());
  star_.for_each_energy([&](std::size_t k, double e) { order[k] = -e; });
  return cavity.grow_across_lowest(order);
}

std::span<const Tet> CavityRefiller::apply() {
  TetMesh& mesh = volume_.mesh();
  const bool with_point = best_.fresh.empty();
  if (with_point) {
    point_ = volume_.add_vertex(best_.place, near_);
    best_.fresh = cone_of(best_.faces, point_);
  }
  if (!std::all_of(best_.fresh.begin(), best_.fresh.end(),
                   [&](const TetMesh::Corners& c) { return volume_.is_positive(c); }) ||
      !is_better(best_) || !volume_.allows(best_.old_tets, best_.fresh)) {
    if (with_point) volume_.remove_last_vertex();
    point_ = kNone;
    return {};
  }
  const auto created = volume_.replace(best_.old_tets, best_.fresh);
  for (const Vertex v : best_.inner) MeshEditor(mesh).remove_vertex(v);
  return created;
}

// In a frame the gain is only approximate, because each element has a metric of its own.
bool CavityRefiller::is_better(const Filling& filling) const {
  if (frame_.is_plain()) return true;
  double after = 0;
  for (const TetMesh::Corners& c : filling.fresh) after += volume_.energy_of(c);
  return is_less(after, volume_.energy(filling.old_tets));
}

}  // namespace holdfast
