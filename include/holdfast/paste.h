// Holdfast: parts that touch, pasted together.
//
// Several surfaces, each of which encloses a part, become one in which the faces that parts share are there
// once: a conformal surface, that `mesh` fills with one region a part. See docs/pasting.md.
#pragma once

#include "holdfast/export.h"
#include "holdfast/holdfast.h"
#include "holdfast/repair.h"
#include "holdfast/types.h"

namespace holdfast {

/// Who gets what several parts hold.
enum class Overlap {
  refuse,  ///< nobody: parts that overlap are `Outcome::invalid_input`
  first,   ///< the first of them
  last,    ///< the last of them
  fresh,   ///< a region of its own, with the next free id: one for each set of parts
};

struct PasteOptions : Limits {
  /// Whether facets that touch or cross are cut so that they fit. If not, only triangles that several parts
  /// have in common become one, and all else stays as it is, valid or not.
  bool cut = true;
  /// What is so near to another part is put on it: first vertices on vertices, then vertices on sides, then
  /// on facets. Earlier parts stay where they are, and no vertex moves further than this.
  double tolerance = 0;
  Overlap overlap = Overlap::refuse;
  /// Whether to find out if parts overlap, which takes a mesh. `mesh` of the result does so in any case.
  bool judge = true;
  std::vector<std::string> labels = {};  ///< of the parts in messages, instead of their names
  Keep keep = Keep::automatic;           ///< what a part holds, as if it were alone: all but Keep::box
  unsigned threads = 1;                  ///< 0: all there are; the result is the same
  ProgressFunction progress = {};
};

/// Of a part: what its regions are called.
struct PastedPart {
  std::string name;               ///< for messages
  std::size_t first_vertex = 0;   ///< of all parts' vertices in turn
  std::size_t first_facet = 0;    ///< of all parts' facets in turn
  int id = 0;                     ///< of regions that no seed numbers
  std::vector<RegionSeed> seeds;  ///< ids are those of the pasted regions
  std::vector<Point> holes;
};

/// Two parts that hold something in common.
struct PartOverlap {
  Index first, second;
  double depth;  ///< the least side of the axis-parallel box round all that both hold
  Point where;   ///< the middle of the box
};

/// A part that no other touches.
struct PartApart {
  Index part, nearest;
  double distance;  ///< to the nearest, computed in floating point
  std::array<Point, 2> where;
};

/// Indices of vertices and facets count through the parts in turn. Markers and names are those of `join`.
struct PasteResult : RepairResult {
  std::vector<PastedPart> parts;
  std::vector<Index> part_of_facet;   ///< of the input
  std::vector<PartOverlap> overlaps;  ///< deepest first; with `PasteOptions::judge` only
  std::vector<PartApart> apart;       ///< the same
  Overlap overlap = Overlap::refuse;  ///< that was asked for
  /// So near to each other parts touch: the tolerance, or as near as coordinates are rounded.
  double gap = 0;
  std::size_t shared_facets = 0;  ///< of the surface, those of several parts
  /// For each entry of `parents.all` whether the facet is turned against this parent.
  std::vector<std::uint8_t> turned;
};

/// Pastes parts together. Facets that several parts have in common are one, which has all of them as parents;
/// where their markers differ it carries the next free number, which `marker_sets` explains.
///
/// Region ids and names are the part's own, where it has seeds or names one region; else part k, from 1, is
/// region k (or the next free one) with the name `names[k - 1]`, if there is one.
///
/// Expected endings are outcomes: parts that overlap are `invalid_input`, unless `overlap` says who gets what
/// they share. Throws what `repair` throws, and std::invalid_argument for fewer than two parts.
[[nodiscard]] HOLDFAST_API PasteResult paste(std::span<const Surface> parts, const PasteOptions& options = {},
                                             std::span<const std::string> names = {});

/// The same for the parts of one surface: its connected components, by the vertices that facets name. One
/// that is turned inside out is a cavity of the smallest that it lies in. Throws std::invalid_argument where
/// there is one part alone. Seeds and holes of the surface are those of every part.
[[nodiscard]] HOLDFAST_API PasteResult paste_components(const Surface& surface,
                                                        const PasteOptions& options = {});

/// Tetrahedral meshes pasted together.
struct PastedVolumes {
  Outcome outcome = Outcome::done;
  /// The vertices of the volumes in turn, each place of the boundaries once, then new ones; the tetrahedra
  /// that stay in turn, each volume's followed by those that replace others. Facets are those of the
  /// boundaries, and those that the volumes list inside.
  Volume volume;
  std::vector<std::int64_t> origin;  ///< by tetrahedron, which of the volumes' in turn it is; -1: a new one
  std::size_t replaced = 0;          ///< tetrahedra of the volumes that are no more
  PasteResult boundary;              ///< of the volumes' boundaries; counts vertices on these in turn
  std::string message;               ///< one sentence when the outcome is not done
};

/// Pastes volumes together: their boundaries as surfaces, and where these changed the tetrahedra at the
/// changed triangles are replaced. All other tetrahedra, and all vertices that do not move, stay bit for bit.
/// Region ids are the volumes' own where there are any. Volumes that overlap are `invalid_input`, whatever
/// `options.overlap` says: their tetrahedra stay. Throws what `paste` of surfaces throws, and
/// std::invalid_argument for volumes whose indices are out of range or whose faces have more than two
/// tetrahedra.
[[nodiscard]] HOLDFAST_API PastedVolumes paste(std::span<const Volume> volumes,
                                               const PasteOptions& options = {},
                                               std::span<const std::string> names = {});

/// Fills what the parts hold: every region is of one part. Regions that no part holds stay empty.
///
/// `options.keep` says what a part holds as if it were alone; with Keep::box, that is as Keep::automatic, and
/// the rest of the box is a region, too. A seed in the options counts before the parts' own. Parts that
/// overlap are `invalid_input`. Throws as `mesh` of a complex does.
[[nodiscard]] HOLDFAST_API Result mesh(const PasteResult& pasted, const Options& options = {});

}  // namespace holdfast
