// Holdfast: figures of the regular tetrahedron, on which bounds of elements rest.
#pragma once

namespace holdfast {

/// sqrt(6) / 4: its circumradius over its edge. No tetrahedron has a smaller ratio to its shortest edge.
inline constexpr double regular_radius_ratio = 0.61237243569579452;

/// (6 sqrt(2))^(1/3): its edge where its volume is 1.
inline constexpr double regular_edge_of_volume_one = 2.0396489026555056;

}  // namespace holdfast
