#include "improve/improve.h"

#include <algorithm>
#include <queue>

#include "improve/add_point.h"
#include "improve/contract.h"
#include "improve/refill.h"
#include "improve/smooth.h"
#include "improve/swap.h"

namespace holdfast {
namespace {

// Passes over the whole volume, and the least angle that the work on single elements aims at.
struct Effort {
  int passes;
  double sine;         // of the angle below which elements are swapped in a pass
  double smooth_sine;  // of the angle below which the vertices of elements are moved in a pass
  double aim;          // of the angle below which single elements are worked on
  double patient_aim;  // of that below which everything is tried on them
  int rounds;
  // For a round, in elements tried, some three microseconds each. Most volumes take a small part of it: it is
  // for those full of elements that the surface forces, which nothing helps.
  double work_per_tet;
};

constexpr Effort effort_of(Quality quality) {
  switch (quality) {
    case Quality::fast:
      return {1, 0.35, 0.50, 0.26, 0.24, 1, 0.2};
    case Quality::good:
      return {1, 0.45, 0.50, 0.36, 0.24, 1, 8};
    case Quality::best:
      break;
  }
  return {6, 0.65, 0.80, 0.60, 0.34, 6, 10};
}

class Improver {
 public:
  Improver(const VolumeData& volume, Quality quality, std::span<const std::uint8_t> spared,
           std::span<const std::uint8_t> fresh, Monitor& monitor)
      : mesh_(volume.mesh),
        volume_(volume, fresh),
        effort_(effort_of(quality)),
        spared_(spared),
        monitor_(monitor),
        smoother_(volume_),
        swapper_(volume_),
        contractor_(volume_),
        adder_(volume_),
        refiller_(volume_) {}

  ImproveStats run() {
    const int steps = effort_.passes + effort_.rounds;
    for (int pass = 0; pass < effort_.passes || (pass < kMostPasses && has_many_bad()); ++pass) {
      stage_ = {static_cast<double>(pass) / steps, 1.0 / steps};
      swap_pass();
      smooth_pass(false);
    }
    for (int round = 0; round < effort_.rounds; ++round) {
      stage_ = {static_cast<double>(effort_.passes + round) / steps, 1.0 / steps};
      volume_.touch_all();
      if (!work_on_the_worst(effort_.aim, effort_.work_per_tet, false)) break;
    }
    // The very worst are few: they get as many rounds as help.
    const double aim = effort_.patient_aim + 0.02;
    for (int round = 0; round < 3 * effort_.rounds; ++round) {
      volume_.touch_all();
      if (!work_on_the_worst(aim, 0.1 * effort_.work_per_tet, true)) break;
    }
    for (Tet t = 0; t < mesh_.slot_count(); ++t)
      if (is_worse(t, stats_.worst)) stats_.worst = volume_.energy(t);
    return stats_;
  }

 private:
  struct Entry {
    double energy;
    Tet tet;
    friend bool operator<(const Entry& x, const Entry& y) {
      return x.energy != y.energy ? x.energy < y.energy : x.tet > y.tet;
    }
  };

  void poll(double fraction) { monitor_.poll(Stage::optimise, stage_[0] + stage_[1] * fraction); }

  // Whether t is to be looked at, being worse than that.
  [[nodiscard]] bool is_worse(Tet t, double from) const {
    return volume_.energy(t) > from && volume_.is_inside(t) && !is_spared(t);
  }
  [[nodiscard]] bool is_spared(Tet t) const {
    const TetMesh::Corners& c = mesh_.corners(t);
    return std::any_of(c.begin(), c.end(), [&](Vertex v) { return v < spared_.size() && spared_[v] != 0; });
  }

  void swap_pass() {
    const double from = energy_of_sine(effort_.sine);
    const auto count = static_cast<double>(mesh_.slot_count());
    // Slots that are filled on the way are met again, here or in the next pass.
    for (Tet t = 0; t < mesh_.slot_count(); ++t) {
      if (!is_worse(t, from) || !volume_.take_changed(t)) continue;
      poll(0.5 * t / count);
      if (!swapper_.improve(t, true).empty()) ++stats_.swapped;
    }
  }

  void smooth_pass(bool patient) {
    const double from = energy_of_sine(effort_.smooth_sine);
    std::vector<std::uint8_t> bad(mesh_.vertex_count(), 0);
    for (Tet t = 0; t < mesh_.slot_count(); ++t)
      if (is_worse(t, from))
        for (const Vertex v : mesh_.corners(t)) bad[v] = 1;
    for (Vertex v = volume_.first_free(); v < mesh_.vertex_count(); ++v) {
      if (bad[v] == 0 || !mesh_.in_mesh(v) || !volume_.take_touched(v)) continue;
      poll(0.5 + 0.5 * v / static_cast<double>(mesh_.vertex_count()));
      if (smoother_.smooth(v, patient)) ++stats_.moved;
    }
  }

  // So many that passes are the faster way.
  [[nodiscard]] bool has_many_bad() const {
    constexpr double kMany = 0.1;
    const double from = energy_of_sine(effort_.aim);
    std::size_t bad = 0;
    for (Tet t = 0; t < mesh_.slot_count(); ++t)
      if (is_worse(t, from)) ++bad;
    return static_cast<double>(bad) > kMany * static_cast<double>(mesh_.tet_count());
  }

  // One element after another, the worst first, each in every way, or in every one but the slowest. Returns
  // whether any became better.
  bool work_on_the_worst(double aim, double work_per_tet, bool refill) {
    constexpr double worth_a_point = energy_of_sine(0.42);  // 25 degrees
    const double from = energy_of_sine(aim);
    std::priority_queue<Entry> queue;
    for (Tet t = 0; t < mesh_.slot_count(); ++t)
      if (is_worse(t, from)) queue.push({volume_.energy(t), t});
    const double count = 1 + static_cast<double>(queue.size());
    work_ = 0;
    const double budget = kLeastWork + work_per_tet * static_cast<double>(mesh_.tet_count());
    bool any = false;
    const auto again = [&](std::span<const Tet> tets) {
      any = any || !tets.empty();
      for (const Tet t : tets)
        if (is_worse(t, from)) queue.push({volume_.energy(t), t});
    };
    while (!queue.empty() && work_ < budget) {
      const Entry worst = queue.top();
      queue.pop();
      if (!volume_.is_inside(worst.tet) || volume_.energy(worst.tet) != worst.energy) continue;
      if (!volume_.take_changed(worst.tet)) continue;
      poll(std::max(work_ / budget, 1 - std::min(1.0, static_cast<double>(queue.size()) / count)));
      work_ += 1;
      if (const auto created = swapper_.improve(worst.tet); !created.empty()) {
        ++stats_.swapped;
        again(created);
        continue;
      }
      if (smooth_a_corner(worst.tet)) {
        again(smoother_.ball());
        continue;
      }
      if (const auto created = contract_a_corner(worst.tet); !created.empty()) {
        ++stats_.contracted;
        again(created);
        continue;
      }
      if (worst.energy > worth_a_point && add_point_at(worst.tet)) {
        ++stats_.inserted;
        again(adder_.ball());
        continue;
      }
      if (refill && worst.energy > very_bad_) again(refill_round(worst.tet));
    }
    return any;
  }

  bool add_point_at(Tet t) {
    const bool is_added = adder_.add(t, volume_.energy(t) > very_bad_);
    work_ += 6 + adder_.work() / 60;
    return is_added;
  }

  std::span<const Tet> refill_round(Tet t) {
    work_ += kRefill;
    const auto created = refiller_.refill(t);
    if (!created.empty()) ++(refiller_.point() != kNone ? stats_.inserted : stats_.swapped);
    return created;
  }

  bool smooth_a_corner(Tet t) {
    const TetMesh::Corners corners = mesh_.corners(t);
    for (const Vertex v : corners)
      if (volume_.may_move(v)) {
        const bool moved = smoother_.smooth(v, true);
        work_ += static_cast<double>(smoother_.ball().size()) / 10;
        if (!moved) continue;
        ++stats_.moved;
        return true;
      }
    return false;
  }

  std::span<const Tet> contract_a_corner(Tet t) {
    constexpr double kLongest = 1.6;  // sizes
    const TetMesh::Corners corners = mesh_.corners(t);
    for (const Vertex v : corners) {
      if (!volume_.may_move(v)) continue;
      const auto created = contractor_.contract(v, kLongest * volume_.size(v));
      work_ += contractor_.work() / 100;
      if (!created.empty()) return created;
    }
    return {};
  }

  static constexpr double kLeastWork = 1500;
  static constexpr double kRefill = 300;  // 0.7 to 1.5 ms, where an element tried is 3 microseconds
  static constexpr int kMostPasses = 6;

  TetMesh& mesh_;
  ImprovedVolume volume_;
  const Effort effort_;
  const std::span<const std::uint8_t> spared_;  // by vertex
  const double very_bad_ = energy_of_sine(effort_.patient_aim);
  Monitor& monitor_;
  VertexSmoother smoother_;
  EnergySwapper swapper_;
  VertexContractor contractor_;
  PointAdder adder_;
  CavityRefiller refiller_;
  std::array<double, 2> stage_{};
  double work_ = 0;
  ImproveStats stats_;
};

}  // namespace

ImproveStats improve(const VolumeData& volume, Quality quality, Monitor& monitor,
                     std::span<const std::uint8_t> spared, std::span<const std::uint8_t> fresh) {
  return Improver(volume, quality, spared, fresh, monitor).run();
}

}  // namespace holdfast
