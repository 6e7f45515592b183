// Regions: the sets of tetrahedra that facets separate (design §2.6).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/tet_mesh.h"

namespace holdfast {

using RegionId = std::uint32_t;

struct Regions {
  /// By tetrahedron slot; 0 is the outside, ghosts included.
  std::vector<RegionId> of_tet;
  RegionId count = 1;  ///< the outside included
  /// By facet: the region that sees its corners turn counterclockwise (in front of its normal), and the
  /// one behind.
  std::vector<std::array<RegionId, 2>> of_facet;
};

/// Floods through faces without facet bits, the outside first; bounded regions are numbered in the order of
/// their least facet, so that the numbers depend on the input alone. Every facet must be a mesh face.
[[nodiscard]] Regions flood_regions(const TetMesh& mesh, std::span<const Triangle> facets);

/// Winding number of each region with respect to the facets that have different regions on their sides, if
/// these are consistently oriented: one value a region such that crossing a facet from front to back adds
/// one. Outside is 0.
[[nodiscard]] std::optional<std::vector<int>> winding_numbers(const Regions& regions);

/// Where a point lies.
struct Located {
  RegionId region = 0;
  bool on_constraint = false;  ///< on a facet, a segment or a vertex
};
[[nodiscard]] Located locate(const TetMesh& mesh, const Regions& regions, const Point& p);

}  // namespace holdfast
