// The Q of a mesh's tetrahedra, each computed once: an exchange looks at the same ones from six edges.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "mesh/parallel.h"
#include "optimise/badness.h"

namespace holdfast {

/// Code that changes tetrahedra, or moves their vertices, has to report it here.
class Qualities {
 public:
  explicit Qualities(const TetMesh& mesh) : mesh_(mesh) {}

  /// Of a living tetrahedron.
  [[nodiscard]] double of(Tet t) {
    if (t >= known_.size()) make_room();
    double& q = known_[t];
    if (std::isnan(q)) q = quality_of(mesh_, mesh_.corners(t));
    return q;
  }
  /// From now on different threads may ask for those of different tetrahedra, as long as there are no more
  /// slots.
  void make_room() { known_.resize(mesh_.slot_count(), kUnknown); }
  /// Computes those of different living tetrahedra.
  void compute(std::span<const Tet> tets, const Threads& threads) {
    make_room();
    parallel_ranges(threads, tets.size(), [&](std::size_t first, std::size_t last) {
      for (const Tet t : tets.subspan(first, last - first)) std::ignore = of(t);
    });
  }
  [[nodiscard]] Badness badness_of(std::span<const Tet> tets, const BadFrom& from) {
    Badness badness;
    for (const Tet t : tets) badness.add(of(t), from);
    return badness;
  }

  /// Of the living tetrahedra that count, in the slots for which `counts(t)` is always the same, and that are
  /// not left out this time, the first one with the worst Q; kNone where none is worse than `good`. After the
  /// first call it takes the time of what has changed and of the blocks looked at, not of the mesh.
  template <typename Counts, typename IsLeftOut>
  [[nodiscard]] Tet worst(double good, Counts&& counts, IsLeftOut&& is_left_out, const Threads& threads) {
    make_room();
    worst_.resize(blocks_before(mesh_.slot_count()), kUnknown);
    parallel_ranges(threads, mesh_.slot_count(), [&](std::size_t first, std::size_t last) {
      for (std::size_t block = blocks_before(first); block < blocks_before(last); ++block)
        if (std::isnan(worst_[block]))
          worst_[block] = worst_in(block, counts, [](Tet) { return false; }).quality;
    });
    std::vector<double> bounds = worst_;
    while (!bounds.empty()) {
      const auto worst = std::max_element(bounds.begin(), bounds.end());
      if (!(*worst > good)) return kNone;
      const Worst found = worst_in(static_cast<std::size_t>(worst - bounds.begin()), counts, is_left_out);
      if (found.quality == *worst) return found.tet;
      *worst = found.quality;  // what was worse is gone, or left out
    }
    return kNone;
  }

  void forget(std::span<const Tet> tets) {
    for (const Tet t : tets) {
      if (t < known_.size()) known_[t] = kUnknown;
      if (t / kBlock < worst_.size()) worst_[t / kBlock] = kUnknown;
    }
  }
  void forget_all() {
    known_.clear();
    worst_.clear();
  }

 private:
  struct Worst {
    double quality = 0;
    Tet tet = kNone;
  };

  // That begin before a slot.
  static std::size_t blocks_before(std::size_t slot) { return (slot + kBlock - 1) / kBlock; }

  template <typename Counts, typename IsLeftOut>
  [[nodiscard]] Worst worst_in(std::size_t block, Counts&& counts, IsLeftOut&& is_left_out) {
    Worst worst;
    const std::size_t end = std::min(mesh_.slot_count(), (block + 1) * kBlock);
    for (auto t = static_cast<Tet>(block * kBlock); t < end; ++t)
      if (mesh_.alive(t) && counts(t) && of(t) > worst.quality && !is_left_out(t)) worst = {of(t), t};
    return worst;
  }

  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  static constexpr std::size_t kBlock = 1024;  // slots

  const TetMesh& mesh_;
  std::vector<double> known_;  // by slot
  // By block of slots, or more where that one is gone; empty until it is asked for.
  std::vector<double> worst_;
};

}  // namespace holdfast
