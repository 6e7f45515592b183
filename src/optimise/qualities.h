// The Q of a mesh's tetrahedra, each computed once: an exchange looks at the same ones from six edges.
#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "mesh/parallel.h"
#include "optimise/badness.h"

namespace holdfast {

/// Whoever changes tetrahedra, or moves their vertices, has to tell.
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

  void forget(std::span<const Tet> tets) {
    for (const Tet t : tets)
      if (t < known_.size()) known_[t] = kUnknown;
  }
  void forget_all() { known_.clear(); }

 private:
  void make_room() { known_.resize(mesh_.slot_count(), kUnknown); }

  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  const TetMesh& mesh_;
  std::vector<double> known_;  // by slot
};

}  // namespace holdfast
