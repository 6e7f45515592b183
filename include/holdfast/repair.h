// Holdfast: makes any surface valid.
//
// Facets that cross, touch or overlap are cut exactly where they meet. The new points are then rounded to
// doubles so that the result is still valid, which an exact test proves. See docs/repairing.md.
#pragma once

#include <concepts>
#include <map>

#include "holdfast/export.h"
#include "holdfast/holdfast.h"
#include "holdfast/limits.h"
#include "holdfast/types.h"

namespace holdfast {

/// A list of indices for each entity.
struct IndexLists {
  std::vector<std::size_t> first{0};  ///< where each list begins in `all`, and where the last one ends
  std::vector<Index> all;

  [[nodiscard]] std::size_t size() const { return first.size() - 1; }
  [[nodiscard]] std::span<const Index> operator[](std::size_t i) const {
    return std::span(all).subspan(first[i], first[i + 1] - first[i]);
  }
};

/// How new points got their doubles. A rung is tried if the one before it did not give a valid surface.
enum class Rung {
  none,     ///< no point was rounded
  nearest,  ///< each is the double nearest to its exact place
  again,    ///< facets that crossed after that were cut and rounded again
  coarser,  ///< what still crossed was joined if some last bits apart: new points, and sides led through
            ///< vertices
  snapped,  ///< the same with vertices of the input: `moved` lists them
};
[[nodiscard]] HOLDFAST_API const char* name(Rung rung);

struct RepairOptions : Limits {
  /// First, vertices within this distance of each other become one, and vertices within it of a side
  /// or facet are put on that side or facet. Two sides get a vertex where they pass each other within this
  /// distance, if they have one facet each, or are of different bodies (facets connected by sides) whose
  /// facets there do not lie in each other; up to 64 last bits of the largest coordinate also within a body.
  /// No vertex moves further than this.
  double weld = 0;
  /// After that, facets that overlap at a distance of at most this get the same triangles where they overlap.
  /// Vertices stay. Where sides cross above each other, a new vertex is put on the larger facet. Meant for
  /// faces of bodies that touch up to rounding, between which a mesh has slivers or no doubles. If the
  /// distance is as long as features, so that this multiplies the facets and most of them cross, an eighth of
  /// it is tried, a 64th, and none; RepairResult::message says so.
  double join = 0;
  /// Closes holes whose border has at most this many sides, by facets without parents. No value: holes stay.
  std::optional<std::size_t> fill_holes = {};
  /// Drops facets with material on both sides or on neither. Material is what `Keep::automatic` keeps of each
  /// connected component of the surface by itself. A component inside another one that faces the other way is
  /// a cavity of it.
  bool unite = false;
  /// The repair ends with `Outcome::memory_limit` if it needs more points than this: an arrangement can be
  /// quadratic in size.
  std::size_t most_points = 100'000'000;
  bool exact = false;    ///< fills `RepairResult::exact`; not with `join`, which rounds earlier
  unsigned threads = 1;  ///< 0: all available; the result is the same
  ProgressFunction progress = {};
};

/// Why a facet of the input is in no facet of the output.
enum class DropReason {
  not_finite,  ///< a corner is NaN or infinite, or its index is out of range
  no_area,     ///< its corners are collinear
  vanished,    ///< after rounding, none of its parts has area
  inner,       ///< `RepairOptions::unite`: material on both sides or on neither
};
[[nodiscard]] HOLDFAST_API const char* name(DropReason reason);

/// Why a hole that should be closed stays open.
enum class OpenReason {
  too_many_sides,  ///< more than the options allow
  meets_surface,   ///< its filling would meet the surface or another filling outside its border
  no_filling,      ///< no filling was found: the hole is not plane and has more than 600 sides, or encloses
                   ///< no area
};
[[nodiscard]] HOLDFAST_API const char* name(OpenReason reason);

struct RepairReport {
  std::size_t vertices = 0, facets = 0, segments = 0;  ///< of the input
  std::size_t pairs = 0;                               ///< of elements that did not fit together
  std::size_t sheets = 0;                 ///< sets of coplanar facets that were triangulated again
  std::size_t points = 0;                 ///< new points of the exact arrangement
  std::size_t rounds = 0;                 ///< rounds of cutting and rounding
  Rung rung = Rung::none;                 ///< the last rung that was needed
  std::size_t changed_facets = 0;         ///< facets of the output that are not whole facets of the input
  std::map<std::string, double> seconds;  ///< by step, and "total"
  std::uint64_t peak_memory_bytes = 0;
};

/// The exact arrangement, before anything is rounded.
struct ExactSurface {
  /// A point that is not a vertex of the input, as quotients "n/d" of decimal integers.
  using Coordinates = std::array<std::string, 3>;
  std::vector<Coordinates> points;  ///< point i is vertex n + i, where the input has n
  std::vector<Triangle> facets;
  IndexLists parents;
};

struct RepairResult {
  struct Moved {
    Index vertex;     ///< of the input, and of the output
    double distance;  ///< correctly rounded up
  };
  struct Dropped {
    Index facet;  ///< of the input
    DropReason reason;
  };
  struct Merged {
    Index facet;  ///< of the input
    Index into;   ///< the first facet with the same corners
  };
  /// A filled hole. With a union: a connected part of what the union leaves of a filling.
  struct Filled {
    std::vector<Index> border;  ///< vertices of the output
    std::vector<Index> facets;  ///< of the output
    bool is_plane;
  };
  struct LeftOpen {
    std::vector<Index> border;  ///< vertices of the output, or empty if a union dropped some of them
    OpenReason reason;
  };

  /// done; not_representable (no rounding was found); or what Limits say.
  Outcome outcome = Outcome::done;
  /// The input's vertices come first, with their indices and, unless they moved, their coordinates; new
  /// vertices follow. Facets have the order and orientation of their first parents. Empty unless `outcome` is
  /// done.
  Surface surface;
  /// For each facet of the surface, the facets of the input that it is a part of, in ascending order: several
  /// where these overlapped, none if it fills a hole.
  IndexLists parents;
  IndexLists segment_parents;  ///< the same for segments
  std::vector<Moved> moved;
  std::vector<Dropped> dropped;
  std::vector<Merged> merged;
  std::vector<Filled> filled;
  std::vector<LeftOpen> left_open;  ///< holes that were to be filled and stay open
  /// Markers of the output that stand for several markers of the input. A facet whose parents have different
  /// markers carries the next free number.
  std::map<int, std::vector<int>> marker_sets;
  /// No point of the output is further than this from the input, and no point of the input from the output,
  /// except on facets that were dropped or fill holes. Rounded up.
  double max_displacement = 0;
  RepairReport report;
  ExactSurface exact;
  std::string message;  ///< one sentence when the outcome is not done, or less was joined than asked for
};

/// Makes a valid surface: one in which `diagnose` finds nothing.
///
/// A valid surface comes out bit for bit. Vertices at one place count as one: facets name the first of them.
/// Facets of zero area, or with corners that are not finite, are dropped, and repeated ones merged. Expected
/// endings are outcomes. Throws std::invalid_argument for markers of a wrong number and for a tolerance that
/// is negative or not finite, or for `exact` with `join`, std::length_error beyond 2^28 vertices, and
/// std::bad_alloc when memory runs out without a limit.
[[nodiscard]] HOLDFAST_API RepairResult repair(const Complex& complex, const RepairOptions& options = {});

/// The same for a surface that owns its arrays, temporaries included.
template <std::same_as<Surface> Owner>
[[nodiscard]] RepairResult repair(const Owner& surface, const RepairOptions& options = {}) {
  return repair(surface.view(), options);
}

/// Meshes a repaired surface that has no mesh in doubles. `repaired` is the repair of `given` with
/// `repairing`, and `result` is the mesh of its surface, in which some Steiner points have no doubles. This
/// happens where sheets are some last bits apart. So the function repairs `given` again with a larger `join`,
/// then also with a larger `weld`, each some last bits of the largest coordinate, and meshes the result with
/// the same options, until there is a mesh. It then returns true, `repaired` and `result` belong to the mesh,
/// and `repairing` has the distances. Otherwise all three stay as they are, except that a limit or a cancel
/// becomes the outcome of `result`. Time limits count for all attempts together.
[[nodiscard]] HOLDFAST_API bool mesh_joined(const Complex& given, const Options& options,
                                            RepairOptions& repairing, RepairResult& repaired, Result& result);

}  // namespace holdfast
