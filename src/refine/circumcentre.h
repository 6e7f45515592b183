// Centres of circles and spheres in floating point, for where points are to be placed: these only propose.
#pragma once

#include "holdfast/types.h"
#include "numbers/vector.h"

namespace holdfast {

/// The centre of the circle through 0, u and w.
inline Vector circle_centre(const Vector& u, const Vector& w) {
  const Vector n = cross(u, w);
  const double nn = dot(n, n), uu = dot(u, u), ww = dot(w, w), uw = dot(u, w);
  const double s = 0.5 * ww * (uu - uw) / nn, r = 0.5 * uu * (ww - uw) / nn;
  return {s * u[0] + r * w[0], s * u[1] + r * w[1], s * u[2] + r * w[2]};
}

/// The centre of the sphere round a tetrahedron, without a division: seen from its first corner and times
/// `scale`, which is twelve volumes.
struct ScaledCentre {
  Vector at;
  double scale;
};
inline ScaledCentre sphere_centre(const Point& p, const Point& q, const Point& r, const Point& s) {
  const Vector u = q - p, v = r - p, w = s - p;
  const Vector vw = cross(v, w), wu = cross(w, u), uv = cross(u, v);
  const double uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
  ScaledCentre centre{{}, 2 * dot(u, vw)};
  for (std::size_t k = 0; k < 3; ++k) centre.at[k] = uu * vw[k] + vv * wu[k] + ww * uv[k];
  return centre;
}

}  // namespace holdfast
