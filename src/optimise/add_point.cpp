#include "optimise/add_point.h"

#include <algorithm>

#include "mesh/editor.h"
#include "mesh/measure.h"
#include "optimise/small_angles.h"
#include "optimise/tuning.h"

namespace holdfast {
namespace {

// The weight of the elements of a cavity, or of the ball in its place.
struct Burden {
  double by_number = 0;  // excess over what new elements may weigh
  double by_volume = 0;

  void add(double weight, double volume) {
    by_number += weight - tuning::kWeightThatPays;
    by_volume += weight * volume;
  }
};

}  // namespace

bool PointAdder::add(Tet t, bool patient) {
  const TetMesh& mesh = volume_.mesh();
  InVain& in_vain = volume_.in_vain();
  const auto way = patient ? InVain::AtEdge::point_with_patience : InVain::AtEdge::point;
  work_ = 0;
  for (int edge = 0; edge < 6; ++edge) {
    const auto [a, b] = ends_of_edge(mesh.corners(t), edge);
    if (mesh.is_segment(t, edge) || !gather_shell(mesh, t, a, b, shell_)) continue;
    if (in_vain.has(mesh, shell_, way)) continue;
    const Point middle = middle_of_shell();
    if (add_at(middle, t, shell_.tets) || (patient && add_at(middle, t, {}))) return true;
    in_vain.add(mesh, shell_, way);
    if (patient) in_vain.add(mesh, shell_, InVain::AtEdge::point);
  }
  return false;
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

// Adds a point in the cavity of these tetrahedra, or, if there are none, in the cavity of the in-sphere test.
bool PointAdder::add_at(const Point& place, Tet t, std::span<const Tet> tets) {
  const RegionId region = volume_.region_of(t);
  const Vertex p = volume_.add_vertex(place, volume_.mesh().corners(t));
  frame_ = volume_.frame_of({&p, 1});
  const bool found = find_cavity(p, t, tets);
  if (!found || !improves(p)) {
    if (found) cavity_.abandon();
    volume_.remove_last_vertex();
    return false;
  }
  cavity_.insert();
  volume_.adopt(cavity_.created(), region);
  return true;
}

bool PointAdder::find_cavity(Vertex p, Tet t, std::span<const Tet> tets) {
  const Tet base = cavity_.locate(p, t);
  if (base == kNone || volume_.mesh().is_ghost(base) || volume_.region_of(base) != volume_.region_of(t))
    return false;
  if (!tets.empty() && std::find(tets.begin(), tets.end(), base) == tets.end()) return false;
  const bool found = tets.empty() ? cavity_.find(p, base, frame_, tuning::kMostAddedBall)
                                  : cavity_.find_among(p, base, tets);
  work_ += static_cast<double>(cavity_.work());
  return found;
}

// Moves p to the best place that sees the same faces; returns whether that reduces the energy.
bool PointAdder::improves(Vertex p) {
  TetMesh& mesh = volume_.mesh();
  star_.clear();
  star_.follow(volume_.rule_in(frame_));
  for (const RimFace& rim : cavity_.rim())
    star_.add(frame_.to(mesh.position(rim.v[0])), frame_.to(mesh.position(rim.v[1])),
              frame_.to(mesh.position(rim.v[2])), 1);
  star_.start_at(frame_.to(mesh.position(p)));
  if (!(star_.energy() < kNoEnergy)) return false;
  star_.step_to_ideal_place();
  const double before = volume_.energy(cavity_.tets());
  if (star_.energy() > tuning::kFarFromGain * before) return false;
  star_.descend();
  if (!is_less(star_.energy(), before)) return false;
  MeshEditor(mesh).move_vertex(p, frame_.from(star_.at()));
  if (!frame_.is_plain() && !is_less(energy_of_ball(p), before)) return false;
  return std::all_of(cavity_.rim().begin(), cavity_.rim().end(),
                     [&](const RimFace& rim) { return mesh.orient(rim.v[0], rim.v[1], rim.v[2], p) > 0; }) &&
         (!must_pay_ || pays(p)) && is_allowed(p);
}

// Mostly the ball has more elements than the cavity. So it may weigh more, by as much as new elements of a
// good mesh would; or less of the volume is bad.
bool PointAdder::pays(Vertex p) const {
  const TetMesh& mesh = volume_.mesh();
  const SmallAngles small(volume_);
  Burden before, after;
  for (const Tet t : cavity_.tets())
    before.add(small.weight(volume_.energy(t)), six_volumes(mesh, mesh.corners(t)));
  for (const RimFace& rim : cavity_.rim()) {
    const TetMesh::Corners corners{rim.v[0], rim.v[1], rim.v[2], p};
    after.add(small.weight(volume_.energy_of(corners)), six_volumes(mesh, corners));
  }
  return after.by_number <= before.by_number ||
         after.by_volume <= tuning::kPartOfVolumeThatPays * before.by_volume;
}

bool PointAdder::is_allowed(Vertex p) {
  if (!volume_.has_standard()) return true;
  std::vector<TetMesh::Corners> fresh;
  for (const RimFace& rim : cavity_.rim()) fresh.push_back({rim.v[0], rim.v[1], rim.v[2], p});
  return volume_.allows(cavity_.tets(), fresh);
}

// The exact value; the star has only an approximate one, because it uses one metric for all elements.
double PointAdder::energy_of_ball(Vertex p) const {
  double sum = 0;
  for (const RimFace& rim : cavity_.rim()) sum += volume_.energy_of({rim.v[0], rim.v[1], rim.v[2], p});
  return sum;
}

}  // namespace holdfast
