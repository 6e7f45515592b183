// Check: exact tests of how points, segments and triangles meet. No constructions, signs only.
#pragma once

#include "holdfast/types.h"

namespace holdfast::checking {

/// Corners of a triangle as coordinates.
using Corners = std::array<const double*, 3>;

/// Sign of component `axis` of (b-a) x (c-a): orient2d of the projections along that axis.
[[nodiscard]] int orient_along(std::size_t axis, const double* a, const double* b, const double* c);

/// Whether the three points are collinear (or coincide).
[[nodiscard]] bool collinear(const double* a, const double* b, const double* c);
/// Whether p lies on the closed segment ab.
[[nodiscard]] bool on_segment(const double* p, const double* a, const double* b);
/// Whether p lies on the closed triangle, which may be of zero area.
[[nodiscard]] bool on_triangle(const double* p, const Corners& triangle);

/// Whether two triangles meet anywhere except in the vertices and the side that they share.
///
/// Vertices are shared by index. Triangles of zero area and pairs with three shared vertices are not
/// accepted. Each triangle is given by its vertices and their coordinates.
[[nodiscard]] bool meet_badly(const Triangle& x, const Corners& x_corners, const Triangle& y,
                              const Corners& y_corners);

/// Whether a segment meets a triangle (of non-zero area) anywhere except in a vertex that they share. False
/// for a segment that is a side of the triangle.
[[nodiscard]] bool meet_badly(const Segment& segment, const double* p, const double* q,
                              const Triangle& triangle, const Corners& corners);

}  // namespace holdfast::checking
