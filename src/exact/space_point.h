// Points of space with rational coordinates: where a line meets a plane, or three planes each other.
//
// Homogeneous integers (x, y, z, w) with w > 0 stand for (x / w, y / w, z / w), and (a, b, c, d) for the
// plane a x + b y + c z + d w = 0. No division occurs but in rounding, which depends on the point alone and
// not on how it was made.
#pragma once

#include <array>

#include "exact/rational_point.h"

namespace holdfast::exact {

struct SpacePoint {
  BigInt x, y, z, w;  ///< w > 0; only powers of two are cancelled
};

struct SpacePlane {
  BigInt a, b, c, d;
};

[[nodiscard]] SpacePoint space_point(const double* p);
/// The plane through three points; all zero where they are collinear.
[[nodiscard]] SpacePlane plane_through(const double* p, const double* q, const double* r);
/// The plane that holds p, q and the direction of a coordinate axis; p and q must differ in its projection.
[[nodiscard]] SpacePlane upright_plane(const double* p, const double* q, unsigned axis);

/// Where the line through p and q meets a plane; they must not be parallel.
[[nodiscard]] SpacePoint crossing(const double* p, const double* q, const SpacePlane& plane);
/// The one point that three planes have in common; there must be just one.
[[nodiscard]] SpacePoint crossing(const SpacePlane& p, const SpacePlane& q, const SpacePlane& r);

/// The doubles nearest to the coordinates, ties to even; infinity beyond the range, never -0.
[[nodiscard]] std::array<double, 3> nearest(const SpacePoint& p);
/// The projection along a coordinate axis: its coordinates are (axis + 1) % 3 and (axis + 2) % 3.
[[nodiscard]] RationalPoint projected(const SpacePoint& p, unsigned axis);

[[nodiscard]] bool equal(const SpacePoint& p, const SpacePoint& q);
/// Sign of p - q in lexicographic order.
[[nodiscard]] int compare(const SpacePoint& p, const SpacePoint& q);
/// At least the distance of p from a point in doubles, by a few units in the last place too much at most; 0
/// only where it is 0.
[[nodiscard]] double distance_bound(const SpacePoint& p, const double* q);

}  // namespace holdfast::exact
