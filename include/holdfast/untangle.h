// Holdfast: makes a tangled volume mesh positive and keeps its boundary.
//
// After P.L. George, H. Borouchaki, E. Saltel, "'Ultimate' robustness in meshing an arbitrary polyhedron"
// (Int. J. Numer. Meth. Engng 2003), §6.4: relocation, exchange of tetrahedra, added points; and V. Garanzha,
// I. Kaporin, L. Kudryavtseva, F. Protais, N. Ray, D. Sokolov, "Foldover-free maps in 50 lines of code" (ACM
// Trans. Graph. 2021) for relocating many points at once.
#pragma once

#include "holdfast/holdfast.h"

namespace holdfast {

/// Steps of untangling. They alternate until no tetrahedron is tangled.
enum class UntangleStep {
  validate,  ///< the connectivity, and the boundary as a surface
  relocate,  ///< vertices one by one, into the kernel of their ball
  swap,      ///< tetrahedra of a region exchanged for others
  smooth,    ///< many vertices at once, with an energy that is infinite for inverted tetrahedra
  refill,    ///< cavities emptied and filled again, as `mesh` fills them
  check,     ///< the result, exactly
  improve,   ///< of elements, once all are positive; before `check`
};

/// Name of a step as the command line and the report spell it.
[[nodiscard]] HOLDFAST_API const char* name(UntangleStep step);

struct UntangleProgress {
  UntangleStep step;
  double fraction;  ///< share of the tetrahedra not positive at first that are positive by now; 0 to 1
};

struct UntangleOptions : Limits {
  std::vector<Index> fixed;  ///< vertices to keep besides those of the boundary, facets and segments
  /// Empties and refills cavities that nothing else untangles; may add and remove points.
  bool refill = true;
  std::uint64_t seed = 1;  ///< of the random orders when refilling
  /// Improves elements once all are positive, also if nothing was tangled. Moves vertices inside, exchanges
  /// tetrahedra, adds and removes vertices. Needs `refill`.
  bool improve = false;
  /// Called from time to time from the calling thread; returns false to cancel.
  std::function<bool(const UntangleProgress&)> progress;
};

struct UntangleReport {
  /// What `improve` did, and its effect. None of the figures gets worse.
  struct Improved {
    std::size_t moves = 0, swaps = 0, contractions = 0, insertions = 0;
    struct Figures {
      double min_dihedral_deg = 0;  ///< the least
      double mean_quality = 0;      ///< mean of the paper's Q, each counted as at most 1e15
      std::size_t below_10_deg = 0, tetrahedra = 0;
    } before, after;
  } improved;
  std::size_t vertices = 0, tetrahedra = 0;  ///< of the input volume
  std::size_t free_vertices = 0;             ///< of these, those that may move
  std::size_t turned = 0;                    ///< tetrahedra that were listed with the opposite orientation
  std::size_t negative = 0, null = 0;        ///< tetrahedra before, once all are oriented alike
  std::size_t negative_after = 0, null_after = 0;  ///< at the end: 0 for Outcome::done
  std::size_t moved = 0;                           ///< vertices that have moved
  std::size_t swapped = 0;                         ///< exchanges of tetrahedra
  std::size_t cavities = 0;                        ///< emptied and filled again
  std::size_t added = 0, removed = 0;              ///< vertices, by `improve`, too
  std::size_t rounds = 0;                          ///< of relocation, swaps and smoothing
  std::map<std::string, double> seconds;           ///< by step, and "total"
  std::uint64_t peak_memory_bytes = 0;
};

struct UntangleResult {
  /// done; invalid_input (the connectivity or the boundary: `message` and `defects` say what and where);
  /// not_representable (no positive mesh in doubles was found); time_limit, memory_limit, cancelled.
  Outcome outcome = Outcome::done;
  Volume volume;  ///< empty unless `outcome` is done
  UntangleReport report;
  /// Defects of the boundary as a surface. Facet i is that of the volume. From volume.facets.size() on,
  /// facets are further faces of the boundary or between regions. Vertices and segments are the volume's.
  std::vector<Defect> defects;
  std::string message;  ///< one sentence when the outcome is not done
};

/// Makes every tetrahedron of a mesh strictly positive, exactly, without changing its boundary.
///
/// `volume` is a mesh by its connectivity: no face has more than two tetrahedra, `facets` are faces and
/// `segments` edges of it. Any of its tetrahedra may be negative or null, and their corners may be listed in
/// any order.
///
/// In the result, the faces of the boundary and between regions, `facets`, `segments` and their vertices are
/// unchanged: coordinates bit for bit, indices and markers included. Every tetrahedron is strictly positive
/// in doubles, no two overlap, and each region fills the space that it filled. Other vertices may have moved.
/// With `refill` some vertices may be new: they take the slots of removed vertices, then come last. A removed
/// vertex whose slot stays free remains as an unused vertex. A mesh without non-positive tetrahedra is
/// unchanged, unless `improve` is set.
///
/// Throws std::invalid_argument if arrays of regions or markers have a wrong length or `fixed` is out of
/// range or `improve` is set without `refill`, std::length_error beyond 2^28 vertices, std::bad_alloc when
/// memory runs out without a limit.
[[nodiscard]] HOLDFAST_API UntangleResult untangle(const Volume& volume, const UntangleOptions& options = {});

}  // namespace holdfast
