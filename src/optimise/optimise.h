// Better elements without field points: exchanges, relocation and reconnection on the worst of them first
// (paper §6.4, §8).
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "holdfast/types.h"
#include "mesh/monitor.h"
#include "mesh/parallel.h"
#include "mesh/tet_mesh.h"

namespace holdfast {

struct OptimiseStats {
  std::size_t exchanged = 0;    ///< face swaps and edge removals
  std::size_t relocated = 0;    ///< moves of a Steiner point
  std::size_t unflattened = 0;  ///< flat tetrahedra removed by several flips
  std::size_t reconnected = 0;  ///< small polyhedra filled in another way
  std::size_t inserted = 0;     ///< points for flat tetrahedra
  /// Points, these or others, removed in the end because the mesh did not need them.
  std::size_t removed = 0;
  std::size_t filled_anew = 0;  ///< polyhedra filled anew
  std::size_t changed = 0;      ///< tetrahedra made, including those of unsuccessful attempts

  OptimiseStats& operator+=(const OptimiseStats& other) {
    exchanged += other.exchanged;
    relocated += other.relocated;
    unflattened += other.unflattened;
    reconnected += other.reconnected;
    inserted += other.inserted;
    removed += other.removed;
    filled_anew += other.filled_anew;
    changed += other.changed;
    return *this;
  }
};

/// The points to remove in the end where the mesh does not need them: all, or only those added here, if the
/// others serve a size.
enum class PointsToRemove { all, added_here };

/// Tetrahedra that fill a complex: its vertices come first, then those added.
struct Filling {
  std::vector<Point> added;
  std::vector<Tetrahedron> tetrahedra;
};
/// The Steiner points that a filling may have: so many left by recovery, and for bad elements some or none.
struct PointsOfFilling {
  std::size_t most_recovered = std::numeric_limits<std::size_t>::max();
  bool may_be_added = true;
  friend bool operator==(const PointsOfFilling&, const PointsOfFilling&) = default;
};
/// A polyhedron, and how to fill it.
struct ToFill {
  Surface polyhedron;
  PointsOfFilling points;
};
/// The fillings likely to be asked for next, at most so many.
using LikelyToFill = std::function<std::vector<ToFill>(std::size_t)>;
/// Fills the space that the facets of a complex enclose; nothing if it cannot. Threads may fill the likely
/// next polyhedra at the same time.
using Filler = std::function<std::optional<Filling>(const ToFill&, const LikelyToFill&)>;

/// How polyhedra round the worst elements are filled anew.
struct FillAnew {
  Filler fill;
  double from_target = 1;  ///< elements this many times as bad as the facets force are worth the work
};

struct OptimiseOptions {
  bool add_points = true;  ///< a few, for tetrahedra that would stay flat
  PointsToRemove remove = PointsToRemove::all;
  std::uint64_t seed = 1;               ///< of the random orders
  const FillAnew* fill_anew = nullptr;  ///< null: no polyhedron is filled anew
};

/// Improves the worst of `tets`. Other tetrahedra of their regions may be replaced for this; all their
/// vertices are explicit. Facets and segments stand, and so do the vertices below `first_free`; the Steiner
/// points, the vertices from there on, lie on no constraint: they may be moved, and removed if they are in
/// the way. `target` is the worst Q that the facets ask for (mesh/quality.h). Large meshes are first searched
/// in parts on several threads (search_in_parts.h), whose number makes no difference to the result.
OptimiseStats optimise(TetMesh& mesh, const std::vector<Tet>& tets, Vertex first_free, double target,
                       const Threads& threads, Monitor& monitor, const OptimiseOptions& options = {});

}  // namespace holdfast
