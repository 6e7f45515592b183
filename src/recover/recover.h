// Recovery by flips: missing segments, then missing facets, without new points (paper §4).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesh/tet_mesh.h"
#include "recover/flipper.h"
#include "recover/pierce.h"
#include "recover/standing.h"
#include "recover/tuning.h"
#include "surface/complex.h"

namespace holdfast {

struct FlipStats {
  std::size_t missing_segments = 0, missing_facets = 0;      ///< before
  std::size_t recovered_segments = 0, recovered_facets = 0;  ///< missing before and standing now
  std::size_t face_flips = 0, edge_removals = 0;             ///< that were carried out
};

/// Recovers missing constraints, and sets their bits in the mesh and their flags in `standing`. No flip ever
/// removes a standing constraint. The mesh has the vertices of the complex, strictly inside the hull, and
/// possibly others.
class FlipRecovery {
 public:
  FlipRecovery(TetMesh& mesh, const ConstraintSet& constraints, std::uint64_t seed);

  /// Called from time to time in long runs, with the part that is done; it may throw.
  using Tell = std::function<void(double)>;

  /// Runs passes over all missing constraints until flips recover no more. If `tell` throws, the mesh and
  /// the flags keep all that was done so far.
  FlipStats run(const Tell& tell, int most_passes = tuning::kMostFlipPasses);

  struct Effort {
    int depth;           ///< levels of flips
    std::size_t budget;  ///< of work at one crossing, in sign tests roughly
    bool thorough;       ///< all crossings of a segment, not only those near its ends
  };
  /// Makes one attempt at a missing segment. Returns whether the segment now stands.
  bool segment(Index s, const Effort& effort);
  /// The same for a missing facet.
  bool facet(Index f, const Effort& effort);

 private:
  void shuffle_in_blocks(std::vector<Index>& missing);
  bool clear_between(Vertex a, Vertex b, const Effort& effort);
  template <typename Attempt>
  void pass_over(std::vector<std::uint8_t>& stands, int most_passes, Attempt attempt, const Tell& tell);

  TetMesh& mesh_;
  const SegmentTable& table_;
  std::span<const Triangle> facets_;
  Standing& standing_;
  Random random_;
  Piercing piercing_;
  Flipper flipper_;
  std::vector<Crossing> crossings_;
  std::vector<PiercingEdge> edges_;
};

}  // namespace holdfast
