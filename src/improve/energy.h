// The energy of a tetrahedron: what improving a volume makes less, summed over tetrahedra.
//
// It is q^-4, where q is the least sine of the six dihedral angles, an obtuse one counting for a little more
// than its sine, since finite elements suffer more from small angles than from large ones only by degree but
// users are shown the small ones. The sine of the angle at edge e between faces of doubled areas m and n is
// |e| D / (m n), where D is six volumes (Freitag, Ollivier-Gooch 1997; Klingner, Shewchuk 2007). The power
// makes a sum of energies follow the worst elements, and yet see how many there are of each kind.
#pragma once

#include <algorithm>
#include <limits>

#include "holdfast/types.h"

namespace holdfast {

inline constexpr double kNoEnergy = std::numeric_limits<double>::infinity();

/// The energy of an element whose least angle has this sine.
[[nodiscard]] constexpr double energy_of_sine(double q) { return 1 / (q * q * q * q); }

/// Infinite for a tetrahedron that is not positive, in floating point.
[[nodiscard]] inline double energy(const Point& a, const Point& b, const Point& c, const Point& d) {
  const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
  const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
  const double wx = d[0] - a[0], wy = d[1] - a[1], wz = d[2] - a[2];
  const double xx = vx - ux, xy = vy - uy, xz = vz - uz;  // bc
  const double yx = wx - ux, yy = wy - uy, yz = wz - uz;  // bd
  const double zx = wx - vx, zy = wy - vy, zz = wz - vz;  // cd
  // Inward normals, or all outward, of the faces opposite a, b, c, d.
  const double ax = yy * xz - yz * xy, ay = yz * xx - yx * xz, az = yx * xy - yy * xx;
  const double bx = vy * wz - vz * wy, by = vz * wx - vx * wz, bz = vx * wy - vy * wx;
  const double cx = wy * uz - wz * uy, cy = wz * ux - wx * uz, cz = wx * uy - wy * ux;
  const double dx = uy * vz - uz * vy, dy = uz * vx - ux * vz, dz = ux * vy - uy * vx;
  const double volume = ux * bx + uy * by + uz * bz;
  if (!(volume > 0)) return kNoEnergy;
  const double ia = 1 / (ax * ax + ay * ay + az * az), ib = 1 / (bx * bx + by * by + bz * bz);
  const double ic = 1 / (cx * cx + cy * cy + cz * cz), id = 1 / (dx * dx + dy * dy + dz * dz);
  // Inward normals at an obtuse edge have a positive product.
  constexpr double kObtuse = 1.5;
  const auto sine2 = [](double length2, double i, double j, double product) {
    const double s = length2 * i * j;
    return product > 0 ? s * kObtuse : s;
  };
  const double ab = sine2(ux * ux + uy * uy + uz * uz, ic, id, cx * dx + cy * dy + cz * dz);
  const double ac = sine2(vx * vx + vy * vy + vz * vz, ib, id, bx * dx + by * dy + bz * dz);
  const double ad = sine2(wx * wx + wy * wy + wz * wz, ib, ic, bx * cx + by * cy + bz * cz);
  const double bc = sine2(xx * xx + xy * xy + xz * xz, ia, id, ax * dx + ay * dy + az * dz);
  const double bd = sine2(yx * yx + yy * yy + yz * yz, ia, ic, ax * cx + ay * cy + az * cz);
  const double cd = sine2(zx * zx + zy * zy + zz * zz, ia, ib, ax * bx + ay * by + az * bz);
  const double least = std::min(std::min(std::min(ab, ac), std::min(ad, bc)), std::min(bd, cd));
  const double q2 = volume * volume * least;
  const double e = 1 / (q2 * q2);
  return e < kNoEnergy ? e : kNoEnergy;
}

}  // namespace holdfast
