#include "optimise/volume.h"

#include "mesh/measure.h"

namespace holdfast {
namespace {

constexpr Tet kTetsALook = 1 << 16;  // some milliseconds

}  // namespace

ImprovedVolume::ImprovedVolume(const VolumeData& data, std::span<const std::uint8_t> fresh,
                               const Threads& threads, double hopeless_sine)
    : data_(data),
      mesh_(data.mesh),
      region_of_(data.region_of),
      rule_{.most = kNoEnergy, .hopeless_sine = hopeless_sine} {
  const auto slots = static_cast<Tet>(mesh_.slot_count());
  energy_.assign(slots, 0);
  compute_energies(threads);
  touched_.assign(fresh.begin(), fresh.end());
  touched_.resize(mesh_.vertex_count(), 1);
  in_vain_.make_room(slots, mesh_.vertex_count());
  changed_.assign(slots, fresh.empty() ? 1 : 0);
  if (fresh.empty()) return;
  for (Tet t = 0; t < slots; ++t) {
    if (t % kTetsALook == 0) threads.poll();
    const TetMesh::Corners& c = mesh_.corners(t);
    if (is_inside(t) && std::any_of(c.begin(), c.end(), [&](Vertex v) { return touched_[v] != 0; }))
      changed_[t] = 1;
  }
}

void ImprovedVolume::judge_by(double hopeless_sine) {
  if (std::exchange(rule_.hopeless_sine, hopeless_sine) != hopeless_sine) compute_energies(Threads(1));
}

void ImprovedVolume::compute_energies(const Threads& threads) {
  const auto slots = static_cast<Tet>(mesh_.slot_count());
  for (Tet first = 0; first < slots; first += std::min(kTetsALook, slots - first)) {
    compute_energies(first, first + std::min(kTetsALook, slots - first));
    threads.poll();
  }
}

// Two at a time, where elements of all regions are judged alike.
void ImprovedVolume::compute_energies(Tet first, Tet last) {
  Tet waiting = kNone;  // for a second one
  for (Tet t = first; t < last; ++t) {
    if (!is_inside(t)) continue;
    if (data_.most_volumes != nullptr) {
      turn_to(t);
      energy_[t] = energy_of(mesh_.corners(t));
      continue;
    }
    if (waiting == kNone) {
      waiting = t;
      continue;
    }
    const Pair both = energies_of(mesh_.corners(waiting), mesh_.corners(t));
    energy_[std::exchange(waiting, kNone)] = both[0];
    energy_[t] = both[1];
  }
  if (waiting != kNone) energy_[waiting] = energy_of(mesh_.corners(waiting));
}

Figures ImprovedVolume::figures(std::span<const Tet> tets) const {
  Figures sum;
  for (const Tet t : tets) {
    const TetMesh::Corners& c = mesh_.corners(t);
    sum.add(mesh_.position(c[0]), mesh_.position(c[1]), mesh_.position(c[2]), mesh_.position(c[3]));
  }
  return sum;
}

Figures ImprovedVolume::figures(std::span<const TetMesh::Corners> tets) const {
  Figures sum;
  for (const TetMesh::Corners& c : tets)
    sum.add(mesh_.position(c[0]), mesh_.position(c[1]), mesh_.position(c[2]), mesh_.position(c[3]));
  return sum;
}

// A frame does not keep volumes.
double ImprovedVolume::energy_in_frame(const TetMesh::Corners& c) const {
  if (rule_.most < kNoEnergy && six_volumes(mesh_, c) > rule_.most) return kNoEnergy;
  const EnergyRule rule{kNoEnergy, rule_.hopeless_sine};
  return data_.see(c, [&rule](const Point& p, const Point& q, const Point& r, const Point& s) {
    return holdfast::energy<double>(p, q, r, s, rule);
  });
}

Pair ImprovedVolume::energies_in_frames(const TetMesh::Corners& x, const TetMesh::Corners& y) const {
  return Pair{energy_in_frame(x), energy_in_frame(y)};
}

}  // namespace holdfast
