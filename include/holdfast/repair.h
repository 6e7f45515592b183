// Holdfast: a valid surface out of any.
//
// Facets that cross, touch or overlap are cut where they meet, exactly; the points where they do are rounded
// to doubles so that the result is still valid, which an exact test proves. See docs/repairing.md.
#pragma once

#include <concepts>
#include <map>

#include "holdfast/export.h"
#include "holdfast/holdfast.h"
#include "holdfast/limits.h"
#include "holdfast/types.h"

namespace holdfast {

/// For each of some entities a list of indices.
struct IndexLists {
  std::vector<std::size_t> first{0};  ///< where each list begins in `all`, and where the last ends
  std::vector<Index> all;

  [[nodiscard]] std::size_t size() const { return first.size() - 1; }
  [[nodiscard]] std::span<const Index> operator[](std::size_t i) const {
    return std::span(all).subspan(first[i], first[i + 1] - first[i]);
  }
};

/// How new points got their doubles. Each follows where the one before did not give a valid surface.
enum class Rung {
  none,     ///< no point was rounded
  nearest,  ///< each is the double nearest to its exact place
  again,    ///< what crossed after that was cut and rounded again
  coarser,  ///< new points that still were in the way went to a coarser grid
  snapped,  ///< vertices of the input, too: `moved` lists them
};
[[nodiscard]] HOLDFAST_API const char* name(Rung rung);

struct RepairOptions : Limits {
  /// Before anything else, vertices within this distance of each other become one, and vertices within it of
  /// a side or facet are put on it. Two sides with one facet each that pass each other within it get a vertex
  /// there. No vertex moves further than this.
  double weld = 0;
  /// After that, facets that overlap at most this far from each other come to have the same triangles where
  /// they do. Vertices stay; new ones, where sides cross above each other, are put onto the larger facet.
  /// Meant for some last bits: between sheets so near a mesh may have no doubles.
  double join = 0;
  /// Closes holes whose border has at most so many sides, by facets without parents. Nothing: leaves them.
  std::optional<std::size_t> fill_holes = {};
  /// Facets that have material on both sides, or on none, go. Material is what `Keep::automatic` keeps of any
  /// connected component of the surface by itself.
  bool unite = false;
  /// More points than this are refused with `Outcome::memory_limit`: an arrangement can be quadratic in size.
  std::size_t most_points = 100'000'000;
  bool exact = false;    ///< fills `RepairResult::exact`; not with `join`, which rounds before
  unsigned threads = 1;  ///< 0: all there are; the result is the same
  ProgressFunction progress = {};
};

/// Why a facet of the input is in no facet of the output.
enum class DropReason {
  not_finite,  ///< a corner is NaN or infinite, or an index that no vertex has
  no_area,     ///< its corners are on one line
  vanished,    ///< rounded, all of its parts have no area
  inner,       ///< `RepairOptions::unite`: the same on both sides
};
[[nodiscard]] HOLDFAST_API const char* name(DropReason reason);

/// Why a hole stays open that was to be closed.
enum class OpenReason {
  too_many_sides,  ///< more than were asked for
  meets_surface,   ///< its filling would meet the surface, or another filling, other than in its border
  no_filling,      ///< none was found: it is not plane and has more than 600 sides, or encloses no area
};
[[nodiscard]] HOLDFAST_API const char* name(OpenReason reason);

struct RepairReport {
  std::size_t vertices = 0, facets = 0, segments = 0;  ///< of the input
  std::size_t pairs = 0;                               ///< of elements that did not fit together
  std::size_t sheets = 0;                 ///< sets of facets of one plane that were triangulated anew
  std::size_t points = 0;                 ///< new points of the exact arrangement
  std::size_t rounds = 0;                 ///< of cutting and rounding
  Rung rung = Rung::none;                 ///< the last that was needed
  std::size_t changed_facets = 0;         ///< of the output, those that are not whole facets of the input
  std::map<std::string, double> seconds;  ///< by step, and "total"
  std::uint64_t peak_memory_bytes = 0;
};

/// The exact arrangement, before anything is rounded.
struct ExactSurface {
  /// A point that is no vertex of the input, as quotients "n/d" of decimal integers.
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
  /// With a union, what it leaves of a filling, in connected parts.
  struct Filled {
    std::vector<Index> border;  ///< vertices of the output
    std::vector<Index> facets;  ///< of the output
    bool is_plane;
  };
  struct LeftOpen {
    std::vector<Index> border;  ///< vertices of the output, or empty where a union took some of them
    OpenReason reason;
  };

  /// done; not_representable (no rounding was found); or what Limits say.
  Outcome outcome = Outcome::done;
  /// The input's vertices with their indices and coordinates, but for those that moved, then the new ones.
  /// Facets stand in the order of their first parents and turned as these. Empty unless `outcome` is done.
  Surface surface;
  /// For each facet of the surface the facets of the input that it is a part of, in ascending order: several
  /// where these overlapped, none where it fills a hole.
  IndexLists parents;
  IndexLists segment_parents;  ///< the same for segments
  std::vector<Moved> moved;
  std::vector<Dropped> dropped;
  std::vector<Merged> merged;
  std::vector<Filled> filled;
  std::vector<LeftOpen> left_open;  ///< other holes, where they were to be filled
  /// Markers of the output that stand for several of the input: facets that parents with different markers
  /// have in common carry the next free number.
  std::map<int, std::vector<int>> marker_sets;
  /// No point of the output is further than this from the input, nor any of the input from the output, but
  /// for facets that were dropped or fill holes. Rounded up.
  double max_displacement = 0;
  RepairReport report;
  ExactSurface exact;
  std::string message;  ///< one sentence when the outcome is not done
};

/// Makes a valid surface: one in which `diagnose` finds nothing.
///
/// A surface that is valid comes out bit for bit. Vertices at one place are one: facets name the first of
/// them. Facets of zero area, or with corners that are not finite, are dropped, and repeated ones merged.
/// Expected endings are outcomes. Throws std::invalid_argument for markers of a wrong number and for a
/// tolerance that is negative or not finite, or for `exact` with `join`, std::length_error beyond 2^28
/// vertices, and std::bad_alloc when memory runs out without a limit.
[[nodiscard]] HOLDFAST_API RepairResult repair(const Complex& complex, const RepairOptions& options = {});

/// The same for a surface that owns its arrays, be it a temporary.
template <std::same_as<Surface> Owner>
[[nodiscard]] RepairResult repair(const Owner& surface, const RepairOptions& options = {}) {
  return repair(surface.view(), options);
}

/// Meshes what was repaired and has no mesh in doubles: `repaired` came of `given`, as `repairing` asks, and
/// `result` of its surface, with Steiner points that have no doubles. That is where sheets are some last bits
/// apart. So `given` is repaired again with a larger `join`, then also with a larger `weld`, some last bits
/// of the largest coordinate each, and meshed with the same options, until there is a mesh. Then the answer
/// is true, `repaired` and `result` are those of the mesh, and `repairing` has the distances. Else they stay,
/// but that a limit or a cancel becomes the outcome of `result`; time limits count for all of it together.
[[nodiscard]] HOLDFAST_API bool mesh_joined(const Complex& given, const Options& options,
                                            RepairOptions& repairing, RepairResult& repaired, Result& result);

}  // namespace holdfast
