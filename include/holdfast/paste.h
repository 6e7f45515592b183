// Holdfast: pastes parts that touch.
//
// Several surfaces, each of which encloses a part, become one conformal surface: a face that parts share
// occurs once. `mesh` fills this surface with one region per part. See docs/pasting.md.
#pragma once

#include "holdfast/export.h"
#include "holdfast/holdfast.h"
#include "holdfast/repair.h"
#include "holdfast/types.h"

namespace holdfast {

/// Which part gets space that several parts contain.
enum class Overlap {
  refuse,  ///< none of them: parts that overlap are `Outcome::invalid_input`
  first,   ///< the first of them
  last,    ///< the last of them
  fresh,   ///< a new region with the next free id, one for each set of parts
};

struct PasteOptions : Limits {
  /// Whether facets that touch or cross are cut so that they fit. If not, only triangles that several parts
  /// have in common are merged. Everything else stays as it is, valid or not.
  bool cut = true;
  /// Vertices within this distance of another part are put on that part: first on its vertices, then on its
  /// sides, then on its facets. Earlier parts stay where they are. No vertex moves further than this.
  double tolerance = 0;
  Overlap overlap = Overlap::refuse;
  /// Whether to find out if parts overlap. This takes a mesh. `mesh` of the result does so in any case.
  bool judge = true;
  std::vector<std::string> labels = {};  ///< of the parts in messages, instead of their names
  Keep keep = Keep::automatic;           ///< what each part contains by itself; not Keep::box
  unsigned threads = 1;                  ///< 0: all available; the result is the same
  ProgressFunction progress = {};
};

/// The regions of a part: their ids, seeds and holes.
struct PastedPart {
  std::string name;               ///< for messages
  std::size_t first_vertex = 0;   ///< in the numbering of all parts together
  std::size_t first_facet = 0;    ///< in the numbering of all parts together
  int id = 0;                     ///< id of regions without a seed
  std::vector<RegionSeed> seeds;  ///< ids are those of the pasted regions
  std::vector<Point> holes;
};

/// Two parts that overlap.
struct PartOverlap {
  Index first, second;
  double depth;      ///< the shortest side of the axis-parallel box round their overlap
  double thickness;  ///< of the overlap's thickest region: twice its volume over its area
  Point where;       ///< the middle of the box
};

/// A part that touches no other.
struct PartApart {
  Index part, nearest;
  double distance;  ///< to the nearest, computed in floating point
  std::array<Point, 2> where;
};

/// Indices of vertices and facets count through the parts in turn. Markers and names are those of `join`.
struct PasteResult : RepairResult {
  std::vector<PastedPart> parts;
  std::vector<Index> part_of_facet;   ///< of the input
  std::vector<PartOverlap> overlaps;  ///< deepest first; only with `PasteOptions::judge`
  std::vector<PartApart> apart;       ///< only with `PasteOptions::judge`, too
  Overlap overlap = Overlap::refuse;  ///< as in the options
  /// Parts within this distance touch: the tolerance, or the rounding of the coordinates.
  double gap = 0;
  std::size_t shared_facets = 0;  ///< facets of the surface that several parts share
  /// For each entry of `parents.all`, whether the facet is turned against that parent.
  std::vector<std::uint8_t> turned;
};

/// Pastes parts together. Facets that several parts have in common become one facet with all of them as
/// parents. If their markers differ, the facet carries the next free number, which `marker_sets` explains.
///
/// Region ids and names are the part's own if it has seeds or names one region. Otherwise part k, from 1, is
/// region k (or the next free one) with the name `names[k - 1]`, if there is one.
///
/// Expected endings are outcomes: parts that overlap are `invalid_input`, unless `overlap` says which part
/// gets the common space. Throws what `repair` throws, and std::invalid_argument for fewer than two parts.
[[nodiscard]] HOLDFAST_API PasteResult paste(std::span<const Surface> parts, const PasteOptions& options = {},
                                             std::span<const std::string> names = {});

/// The same for the parts of one surface: its connected components, by the vertices that facets name. A
/// component turned inside out is a cavity of the smallest component round it. Throws std::invalid_argument
/// if there is only one part. Seeds and holes of the surface are those of every part.
[[nodiscard]] HOLDFAST_API PasteResult paste_components(const Surface& surface,
                                                        const PasteOptions& options = {});

/// Tetrahedral meshes pasted together.
struct PastedVolumes {
  Outcome outcome = Outcome::done;
  /// Vertices: those of the volumes in turn, each place of the boundaries once, then new ones. Tetrahedra:
  /// volume by volume, those that stay, then their replacements. Facets: those of the boundaries, and inner
  /// ones that the volumes list.
  Volume volume;
  /// By tetrahedron: its number through all volumes in turn; -1: a new one.
  std::vector<std::int64_t> origin;
  std::size_t replaced = 0;  ///< tetrahedra of the volumes that were replaced
  /// Of the volumes' boundaries; counts vertices on the boundaries in turn.
  PasteResult boundary;
  std::string message;  ///< one sentence when the outcome is not done
};

/// Pastes volumes together. Their boundaries are pasted as surfaces, and the tetrahedra at triangles that
/// changed are replaced. All other tetrahedra, and all vertices that do not move, stay bit for bit. Region
/// ids are the volumes' own if there are any. Volumes that overlap are `invalid_input`, whatever
/// `options.overlap` says: their tetrahedra stay. Throws what `paste` of surfaces throws, and
/// std::invalid_argument for volumes whose indices are out of range or whose faces have more than two
/// tetrahedra.
[[nodiscard]] HOLDFAST_API PastedVolumes paste(std::span<const Volume> volumes,
                                               const PasteOptions& options = {},
                                               std::span<const std::string> names = {});

/// Fills the parts with tetrahedra. Every region belongs to one part. Regions in no part stay empty.
///
/// `options.keep` says what each part contains by itself. With Keep::box, parts are kept as with
/// Keep::automatic, and the rest of the box is a region, too. A seed in the options takes precedence over the
/// parts' own. Parts that overlap are `invalid_input`. Throws as `mesh` of a complex does.
[[nodiscard]] HOLDFAST_API Result mesh(const PasteResult& pasted, const Options& options = {});

}  // namespace holdfast
