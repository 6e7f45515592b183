// The data for improving a volume: the mesh, its regions, and the energy of each tetrahedron.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "mesh/editor.h"
#include "mesh/exchange.h"
#include "mesh/parallel.h"
#include "optimise/energy.h"
#include "optimise/figures.h"
#include "optimise/in_vain.h"
#include "optimise/tuning.h"
#include "refine/levels.h"
#include "refine/volume_data.h"

namespace holdfast {

class ImprovedVolume {
 public:
  /// Free vertices may move and be removed. All vertices of kept tetrahedra are explicit. Tetrahedra at
  /// vertices that `fresh` marks, or with numbers beyond its end, count as changed. Energies grow less
  /// steeply below the hopeless sine.
  explicit ImprovedVolume(const VolumeData& data, std::span<const std::uint8_t> fresh = {},
                          const Threads& threads = 1, double hopeless_sine = tuning::kHopelessSine,
                          double saturation = 0);

  [[nodiscard]] TetMesh& mesh() { return mesh_; }
  [[nodiscard]] const TetMesh& mesh() const { return mesh_; }
  [[nodiscard]] Vertex first_free() const { return data_.first_free; }
  [[nodiscard]] std::uint64_t seed() const { return data_.seed; }
  [[nodiscard]] bool is_inside(Tet t) const { return data_.is_inside(t); }
  [[nodiscard]] bool may_move(Vertex v) const { return v >= data_.first_free; }

  /// From now on, elements are judged as those of the region of t: by the most that these may measure.
  void turn_to(Tet t) { turn_to_region(region_of_[t]); }
  /// From now on, energies grow less steeply below that sine, without a bound.
  void judge_by(double hopeless_sine);
  /// For elements that are seen in a frame, where a bound on volumes means nothing unless it is plain.
  [[nodiscard]] EnergyRule rule_in(const Frame& frame) const {
    return {frame.is_plain() ? rule_.most : kNoEnergy, rule_.hopeless_sine, rule_.saturation};
  }
  [[nodiscard]] double energy_of_sine(double q) const { return holdfast::energy_of_sine(q, rule_); }

  /// Of a living tetrahedron inside.
  [[nodiscard]] double energy(Tet t) const { return energy_[t]; }
  [[nodiscard]] double energy(std::span<const Tet> tets) const {
    double sum = 0;
    for (const Tet t : tets) sum += energy_[t];
    return sum;
  }
  [[nodiscard]] double energy_of(const TetMesh::Corners& c) const {
    if (data_.metrics != nullptr) [[unlikely]]
      return energy_in_frame(c);
    return holdfast::energy<double>(mesh_.position(c[0]), mesh_.position(c[1]), mesh_.position(c[2]),
                                    mesh_.position(c[3]), rule_);
  }
  /// Of two, in little more time than of one.
  [[nodiscard]] Pair energies_of(const TetMesh::Corners& x, const TetMesh::Corners& y) const {
    if (data_.metrics != nullptr) [[unlikely]]
      return energies_in_frames(x, y);
    std::array<PointOf<Pair>, 4> p;
    for (std::size_t i = 0; i < 4; ++i) {
      const Point &of_x = mesh_.position(x[i]), &of_y = mesh_.position(y[i]);
      for (std::size_t k = 0; k < 3; ++k) p[i][k] = Pair{of_x[k], of_y[k]};
    }
    return holdfast::energy<Pair>(p[0], p[1], p[2], p[3], rule_);
  }
  /// Of one to four, each what it would be by itself.
  [[nodiscard]] std::array<double, 4> energies_of(std::span<const TetMesh::Corners> tets) const;
  [[nodiscard]] bool is_positive(const TetMesh::Corners& c) const {
    return mesh_.orient(c[0], c[1], c[2], c[3]) > 0;
  }

  /// The frame for the elements round some vertices, approximately: each element has a different metric.
  [[nodiscard]] Frame frame_of(std::span<const Vertex> vertices) const { return data_.frame_of(vertices); }
  /// The desired length of edges, and the length of one, in the metric if there is one.
  [[nodiscard]] double size(Vertex v) const { return data_.size_in_frame(v); }
  [[nodiscard]] double length(Vertex v, Vertex w) const { return data_.length(v, w); }

  /// What the user alone wants where t is; infinite without a limit.
  [[nodiscard]] double most_size(Tet t) const { return data_.most_size(region_of_[t]); }
  /// Adds a vertex with the size and metric of those near it.
  Vertex add_vertex(const Point& place, const TetMesh::Corners& near) {
    const Vertex p = MeshEditor(mesh_).add_vertex(place);
    data_.sizes.resize(mesh_.vertex_count(), 0);
    for (const Vertex v : near) data_.sizes[p] = std::max(data_.sizes[p], data_.sizes[v]);
    if (data_.metrics != nullptr) data_.metrics->push_back(data_.mean_metric(near));
    return p;
  }
  void remove_last_vertex() {
    MeshEditor(mesh_).remove_last_vertex();
    data_.sizes.pop_back();
    if (data_.metrics != nullptr) data_.metrics->pop_back();
  }

  /// Whether a tetrahedron, or the ball of a vertex, is new or has changed since this was last asked.
  [[nodiscard]] bool take_changed(Tet t) { return std::exchange(changed_[t], std::uint8_t{0}) != 0; }
  [[nodiscard]] bool take_touched(Vertex v) { return std::exchange(touched_[v], std::uint8_t{0}) != 0; }
  void touch_all() {
    std::fill(changed_.begin(), changed_.end(), std::uint8_t{1});
    std::fill(touched_.begin(), touched_.end(), std::uint8_t{1});
  }

  /// Marks the tetrahedra at vertices touched since the last call as changed. Elsewhere, trials that failed
  /// before would fail again.
  void touch_beside_touched() {
    for (Tet t = 0; t < mesh_.slot_count(); ++t) {
      const TetMesh::Corners& c = mesh_.corners(t);
      if (is_inside(t) && std::any_of(c.begin(), c.end(), [&](Vertex v) { return touched_[v] != 0; }))
        changed_[t] = 1;
    }
    std::fill(touched_.begin(), touched_.end(), std::uint8_t{0});
  }

  /// From now on, no change may make the figures of the whole worse than they are.
  void keep(const Figures& figures) { standard_.emplace(figures); }
  /// Whether points may be added at all.
  [[nodiscard]] bool may_add() const { return data_.levels == nullptr; }
  /// Whether figures are kept at all, and whether tetrahedra may be replaced by others. What is allowed is
  /// taken to be done.
  [[nodiscard]] bool has_standard() const { return standard_.has_value(); }
  [[nodiscard]] bool allows(std::span<const Tet> old_tets, std::span<const TetMesh::Corners> fresh) {
    if (data_.levels != nullptr && !data_.levels->allow(mesh_, old_tets, fresh)) [[unlikely]]
      return false;
    return !standard_ || standard_->allows(figures(old_tets), figures(fresh));
  }
  [[nodiscard]] bool allows(const Figures& old, std::span<const Tet> fresh) {
    return !standard_ || standard_->allows(old, figures(fresh));
  }
  [[nodiscard]] Figures figures(std::span<const Tet> tets) const;
  [[nodiscard]] Figures figures(std::span<const TetMesh::Corners> tets) const;

  /// Replaces tetrahedra inside one region. Returns the new ones, until the next call.
  std::span<const Tet> replace(std::span<const Tet> old_tets, std::span<const TetMesh::Corners> fresh) {
    const RegionId region = region_of_[old_tets.front()];
    created_.clear();
    MeshEditor(mesh_).replace({.old_tets = old_tets, .new_tets = fresh}, &created_);
    adopt(created_, region);
    return created_;
  }
  std::span<const Tet> make(const Exchange& exchange) {
    const RegionId region = region_of_[exchange.old_tets.front()];
    created_.clear();
    holdfast::make(mesh_, exchange, created_);
    adopt(created_, region);
    return created_;
  }
  /// Records tetrahedra that were made otherwise.
  void adopt(std::span<const Tet> tets, RegionId region) {
    if (energy_.size() < mesh_.slot_count()) {
      energy_.resize(mesh_.slot_count(), 0);
      changed_.resize(mesh_.slot_count(), 1);
      in_vain_.make_room(mesh_.slot_count(), mesh_.vertex_count());
      region_of_.resize(mesh_.slot_count(), kNone);
    }
    if (touched_.size() < mesh_.vertex_count()) {
      touched_.resize(mesh_.vertex_count(), 1);
      in_vain_.make_room(energy_.size(), mesh_.vertex_count());
    }
    turn_to_region(region);
    for (const Tet t : tets) {
      region_of_[t] = region;
      note(t, energy_of(mesh_.corners(t)));
    }
  }
  /// Records the new energy of a tetrahedron after one of its vertices moved.
  void note(Tet t, double energy) {
    energy_[t] = energy;
    changed_[t] = 1;
    in_vain_.forget(t, mesh_.corners(t));
    for (const Vertex v : mesh_.corners(t)) touched_[v] = 1;
  }
  [[nodiscard]] InVain& in_vain() { return in_vain_; }
  [[nodiscard]] RegionId region_of(Tet t) const { return region_of_[t]; }

 private:
  void compute_energies(const Threads& threads);
  void compute_energies(Tet first, Tet last);
  // Slightly below the bound, within which floating point cannot decide.
  void turn_to_region(RegionId region) {
    constexpr double kSurely = 1 - 1e-9;
    if (data_.most_volumes != nullptr) [[unlikely]]
      rule_.most = 6 * kSurely * (*data_.most_volumes)[region];
  }
  [[nodiscard]] double energy_in_frame(const TetMesh::Corners& c) const;
  HOLDFAST_WITH_FOURS void put_energies_by_fours(std::span<const TetMesh::Corners> tets,
                                                 std::array<double, 4>& energies) const;
  [[nodiscard]] Pair energies_in_frames(const TetMesh::Corners& x, const TetMesh::Corners& y) const;

  const VolumeData data_;
  TetMesh& mesh_;
  std::vector<RegionId>& region_of_;
  std::vector<double> energy_;  // by slot
  EnergyRule rule_;
  std::optional<Standard> standard_;
  std::vector<std::uint8_t> changed_, touched_;
  InVain in_vain_;
  std::vector<Tet> created_;
};

/// Whether a change of a sum of energies is worth making; differences below are rounding or not worth the
/// time.
[[nodiscard]] inline bool is_less(double after, double before) {
  return after < before * (1 - tuning::kEnergyRounding) - tuning::kLeastEnergyGain;
}

}  // namespace holdfast
