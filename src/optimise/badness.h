// How bad a set of tetrahedra is: the order in which every change of the optimisation must go down.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "mesh/tet_mesh.h"

namespace holdfast {

/// The paper's Q of the doubles nearest to four vertices (mesh/quality.h): 1 is regular, more is worse.
[[nodiscard]] double quality_of(const TetMesh& mesh, const TetMesh::Corners& corners);

/// Part of the worst Q that is left by a change worth its time, at most.
inline constexpr double kLeastGain = 0.98;

/// The number of flat tetrahedra, then the worst Q of all.
///
/// Flat ones, of a Q that no facet asks for, come in heaps, where points of one plane or sphere differ from
/// it by rounding. Their Q is chance: a heap goes one by one, only where a worse one may stay a while.
struct Badness {
  std::size_t flat = 0;
  double worst = 0;

  void add(double quality, double flat_from) {
    if (!(quality < flat_from)) ++flat;
    worst = std::max(worst, quality);
  }
  /// Whether this is better than `other` by so much that the change is worth its time.
  [[nodiscard]] bool is_worthwhile_after(const Badness& other) const {
    return flat != other.flat ? flat < other.flat : worst < kLeastGain * other.worst;
  }
  friend bool operator<(const Badness& x, const Badness& y) {
    return x.flat != y.flat ? x.flat < y.flat : x.worst < y.worst;
  }
};

/// The edges of a flat tetrahedron where it is open widest, one of which has to go, as far as no constraint
/// holds it: one or two of a sliver, three of a cap.
[[nodiscard]] std::vector<int> wide_edges(const TetMesh& mesh, Tet t);

[[nodiscard]] Badness badness_of(const TetMesh& mesh, std::span<const Tet> tets, double flat_from);

}  // namespace holdfast
