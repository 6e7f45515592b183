#include "optimise/volume.h"

#include "mesh/measure.h"

namespace holdfast {
namespace {

constexpr Tet kTetsALook = 1 << 16;  // some milliseconds

}  // namespace

ImprovedVolume::ImprovedVolume(const VolumeData& data, std::span<const std::uint8_t> fresh,
                               const Threads& threads, double hopeless_sine, double saturation)
    : data_(data),
      mesh_(data.mesh),
      region_of_(data.region_of),
      rule_{.most = kNoEnergy, .hopeless_sine = hopeless_sine, .saturation = saturation} {
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
  const bool is_saturated = std::exchange(rule_.saturation, 0) > 0;
  if (std::exchange(rule_.hopeless_sine, hopeless_sine) != hopeless_sine || is_saturated)
    compute_energies(Threads(1));
}

void ImprovedVolume::compute_energies(const Threads& threads) {
  const auto slots = static_cast<Tet>(mesh_.slot_count());
  for (Tet first = 0; first < slots; first += std::min(kTetsALook, slots - first)) {
    compute_energies(first, first + std::min(kTetsALook, slots - first));
    threads.poll();
  }
}

// Four at a time if elements of all regions are judged by the same measure.
void ImprovedVolume::compute_energies(Tet first, Tet last) {
  std::array<Tet, 4> tets{};
  std::array<TetMesh::Corners, 4> corners;
  std::size_t waiting = 0;
  const auto compute_waiting = [&] {
    const std::array<double, 4> energies = energies_of({corners.data(), waiting});
    for (std::size_t k = 0; k < waiting; ++k) energy_[tets[k]] = energies[k];
    waiting = 0;
  };
  for (Tet t = first; t < last; ++t) {
    if (!is_inside(t)) continue;
    if (data_.most_volumes != nullptr) {
      turn_to(t);
      energy_[t] = energy_of(mesh_.corners(t));
      continue;
    }
    tets[waiting] = t;
    corners[waiting] = mesh_.corners(t);
    if (++waiting == corners.size()) compute_waiting();
  }
  if (waiting > 0) compute_waiting();
}

std::array<double, 4> ImprovedVolume::energies_of(std::span<const TetMesh::Corners> tets) const {
  static const bool by_fours = has_fours();
  std::array<double, 4> energies{};
  if (by_fours && data_.metrics == nullptr && tets.size() > 2) {
    put_energies_by_fours(tets, energies);
    return energies;
  }
  for (std::size_t k = 0; k < tets.size(); k += 2) {
    const Pair both = energies_of(tets[k], tets[std::min(k + 1, tets.size() - 1)]);
    energies[k] = both[0];
    energies[k + 1] = both[1];
  }
  return energies;
}

HOLDFAST_WITH_FOURS void ImprovedVolume::put_energies_by_fours(std::span<const TetMesh::Corners> tets,
                                                               std::array<double, 4>& energies) const {
  const TetMesh::Corners &c0 = tets[0], &c1 = tets[1], &c2 = tets[2],
                         &c3 = tets[std::min<std::size_t>(3, tets.size() - 1)];
  std::array<PointOf<Four>, 4> p;
  for (std::size_t i = 0; i < 4; ++i) {
    const Point &p0 = mesh_.position(c0[i]), &p1 = mesh_.position(c1[i]), &p2 = mesh_.position(c2[i]),
                &p3 = mesh_.position(c3[i]);
    for (std::size_t k = 0; k < 3; ++k) p[i][k] = Four{p0[k], p1[k], p2[k], p3[k]};
  }
  Four e{};
  put_energy<Four>(p[0], p[1], p[2], p[3], rule_, e);
  for (std::size_t k = 0; k < 4; ++k) energies[k] = e[k];
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

// A frame does not preserve volumes.
double ImprovedVolume::energy_in_frame(const TetMesh::Corners& c) const {
  if (rule_.most < kNoEnergy && six_volumes(mesh_, c) > rule_.most) return kNoEnergy;
  const EnergyRule rule{kNoEnergy, rule_.hopeless_sine, rule_.saturation};
  return data_.see(c, [&rule](const Point& p, const Point& q, const Point& r, const Point& s) {
    return holdfast::energy<double>(p, q, r, s, rule);
  });
}

Pair ImprovedVolume::energies_in_frames(const TetMesh::Corners& x, const TetMesh::Corners& y) const {
  return Pair{energy_in_frame(x), energy_in_frame(y)};
}

}  // namespace holdfast
