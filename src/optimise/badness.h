// How bad a set of tetrahedra is: the order in which every change of the optimisation must go down.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "mesh/tet_mesh.h"
#include "optimise/tuning.h"

namespace holdfast {

/// The paper's Q of the doubles nearest to four vertices (mesh/quality.h): 1 is regular, more is worse.
[[nodiscard]] double quality_of(const TetMesh& mesh, const TetMesh::Corners& corners);

/// Values of Q at which classes of tetrahedra begin: flat ones, whose Q no facet forces; hopeless ones, which
/// are worth a point; and null ones, whose vertices are coplanar up to rounding.
struct BadFrom {
  double flat, hopeless = std::numeric_limits<double>::infinity(),
               null = std::numeric_limits<double>::infinity();

  /// What comes for a tetrahedron of this Q has to be below. A thin room may hold nothing but flat ones, yet
  /// these are of use, and null ones of none.
  [[nodiscard]] double limit_for(double quality) const {
    return quality < null ? std::min(flat, tuning::kLeastGain * quality) : null;
  }
};

/// The numbers of null, of hopeless and of flat tetrahedra, then the worst Q of all.
///
/// These come in heaps, where points of one plane or sphere differ from it by rounding. Their Q is chance: a
/// heap goes one by one, only where a worse one may stay a while. But for fewer flat ones none may become
/// hopeless: a point that parts a cap into three flat ones would not last.
struct Badness {
  std::size_t null = 0, hopeless = 0, flat = 0;
  double worst = 0;

  void add(double quality, const BadFrom& from) {
    if (!(quality < from.null)) ++null;
    if (!(quality < from.hopeless)) ++hopeless;
    if (!(quality < from.flat)) ++flat;
    worst = std::max(worst, quality);
  }
  /// Whether this is better than `other` by so much that the change is worth its time.
  [[nodiscard]] bool is_worthwhile_after(const Badness& other) const {
    return counts() != other.counts() ? counts() < other.counts() : worst < tuning::kLeastGain * other.worst;
  }
  friend bool operator<(const Badness& x, const Badness& y) {
    return x.counts() != y.counts() ? x.counts() < y.counts() : x.worst < y.worst;
  }

  [[nodiscard]] std::array<std::size_t, 3> counts() const { return {null, hopeless, flat}; }
};

/// Of two sets together.
[[nodiscard]] inline Badness join(const Badness& x, const Badness& y) {
  return {x.null + y.null, x.hopeless + y.hopeless, x.flat + y.flat, std::max(x.worst, y.worst)};
}

/// The edges of a flat tetrahedron where it is open widest, one of which has to go, as far as no constraint
/// holds it: one or two of a sliver, three of a cap.
[[nodiscard]] std::vector<int> wide_edges(const TetMesh& mesh, Tet t);

[[nodiscard]] Badness badness_of(const TetMesh& mesh, std::span<const Tet> tets, const BadFrom& from);

}  // namespace holdfast
