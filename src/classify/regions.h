// Regions: the sets of tetrahedra that facets separate, their winding numbers, where a point lies
// (docs/concepts.md, Regions).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/parallel.h"
#include "mesh/tet_mesh.h"

namespace holdfast {

using RegionId = std::uint32_t;

struct Regions {
  /// By tetrahedron slot; 0 is the outside, ghosts included; kNone for free slots.
  std::vector<RegionId> of_tet;
  RegionId count = 1;  ///< the outside included
  /// By facet: the region that sees its corners turn counterclockwise (in front of its normal), and the
  /// one behind.
  std::vector<std::array<RegionId, 2>> of_facet;
};

/// Regions are connected through faces without facet bits. Bounded regions are numbered in the order of their
/// lowest facet (in front before behind), so the numbers depend only on the complex.
///
/// Throws std::logic_error unless the faces with facet bits are exactly the facets.
[[nodiscard]] Regions find_regions(const TetMesh& mesh, std::span<const Triangle> facets,
                                   const Threads& threads = 1);

/// Finds the tetrahedra of every region again after changes of the mesh, which left the facets as they were.
void find_regions_again(TetMesh& mesh, std::span<const Triangle> facets, Regions& regions,
                        const Threads& threads = 1);

/// Winding numbers with respect to the facets that have different regions on their sides.
struct Winding {
  /// By region: crossing a facet from front to back adds one, and the outside is 0; so a shell whose
  /// facets all face outwards gives 1 inside. Meaningless in case of a conflict.
  std::vector<int> number;
  /// Two facets (or one, twice) on a closed path along which the number does not return to its value:
  /// then the facets are not consistently oriented.
  std::optional<std::array<Index, 2>> conflict;
};
/// Facets that are turned against most others between the same two regions, in ascending order. There may be
/// a conflict without: where an interface parts two regions that would have the same number.
[[nodiscard]] std::vector<Index> turned_facets(const Regions& regions);

[[nodiscard]] Winding winding_numbers(const Regions& regions);

/// Where a point lies; `region` is one of those that touch it.
struct Located {
  RegionId region = 0;
  bool in_mesh = false;   ///< false: beyond the hull
  bool on_facet = false;  ///< in the closed triangle of some facet
};

/// Exact. Tests every tetrahedron, most of them only by their box. A walk is not sure to end, because a mesh
/// with constraints is not a Delaunay triangulation, and there are few such points.
[[nodiscard]] Located locate(const TetMesh& mesh, const Regions& regions, exact::PointRef p);

}  // namespace holdfast
