// Which regions stay in the volume, and their ids (docs/concepts.md, Regions).
#pragma once

#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "classify/named_complex.h"
#include "classify/parts.h"
#include "classify/regions.h"
#include "holdfast/holdfast.h"
#include "surface/complex.h"
#include "surface/places.h"

namespace holdfast {

struct Kept {
  std::vector<bool> region;   ///< by region of Regions: whether it stays
  std::vector<int> id;        ///< by region: the id that users see; 0 unless seeded for the outside
  std::vector<bool> segment;  ///< by segment of the table: whether it borders on a kept region
  Keep rule = Keep::bounded;  ///< that was applied: never Keep::automatic
  /// Two facets that rule out winding numbers, if Keep::automatic met such; and the facets turned against
  /// others, if these are the reason.
  std::optional<std::array<Index, 2>> conflict;
  std::vector<Index> turned;
  std::vector<Defect> defects;        ///< of kinds 14 to 16; empty when all is well
  std::vector<PartOverlap> overlaps;  ///< of parts, whether or not they are refused

  /// Whether a facet borders on a kept region.
  [[nodiscard]] bool facet(const Regions& regions, Index f) const {
    return region[regions.of_facet[f][0]] || region[regions.of_facet[f][1]];
  }
};

/// The user's choice of regions. Holes and seeds are in the complex's units.
struct Wanted {
  Keep keep = Keep::automatic;
  std::span<const Point> holes;
  std::span<const RegionSeed> seeds;
  /// Leave out elements that border on no kept region, instead of reporting a defect.
  bool drop_outside = false;
  /// For a pasted surface: the regions of the parts are kept with the parts' ids, except holes and regions to
  /// which `seeds` give other ids.
  const PartsOfComplex* parts = nullptr;
};

/// Applies the keep rule, holes and region seeds, then looks for elements that border on no kept region.
///
/// A region with a seed has the seed's id; Keep::automatic keeps it whatever its winding number. Other kept
/// regions have the lowest positive ids that no seed takes, in the order of their numbers. If parts overlap
/// that must not, no region is chosen. The mesh is the complex times 2^scale.
///
/// Throws std::invalid_argument for a hole or region seed that lies on a facet or in no region that it
/// could mean, and for seeds that give one region two ids.
[[nodiscard]] Kept choose_regions(const TetMesh& mesh, const Regions& regions, const NamedComplex& input,
                                  const Wanted& wanted, int scale = 0);

/// The exception for a hole or region seed (`what`) at a place where it has no meaning.
[[nodiscard]] std::invalid_argument on_the_surface(const std::string& what, const Point& p);
[[nodiscard]] std::invalid_argument in_no_region(const std::string& what, const Point& p);
[[nodiscard]] std::invalid_argument in_region_not_kept(const Point& seed);
/// `id` is that of another seed in the region; `border` a vertex of an open border in it, if there is one, as
/// `names` calls it.
[[nodiscard]] std::invalid_argument with_two_ids(const RegionSeed& seed, int id, const Complex& complex,
                                                 std::optional<Index> border, const VertexNames& names);

/// The warning that every bounded region was kept because there are no winding numbers.
[[nodiscard]] Warning warn_of_turned(const Complex& complex, const std::vector<Index>& turned);

}  // namespace holdfast
