// The energy of a tetrahedron. Improvement lowers the sum of the energies of a volume.
//
// The energy is q^-4. Below some q it is less steep, q^-2: otherwise elements forced by needles of the
// surface would count for more than all elements that can be improved. With a saturation, it is even bounded
// there: hardly any work is then done for elements that cannot become good anyway. Here q is the least sine
// of the six dihedral angles. An obtuse angle counts for a little more than its sine: finite elements suffer
// only somewhat less from large angles than from small ones, but users are shown the small ones. The sine of
// the angle at edge e between faces of doubled areas m and n is |e| D / (m n), where D is six volumes
// (Freitag, Ollivier-Gooch 1997; Klingner, Shewchuk 2007). The power makes a sum of energies follow the worst
// elements, and yet see how many there are of each kind. With a metric, an element is measured in the frame
// of the mean metric of its corners. A tetrahedron above a bound on volumes is as bad as one that is not
// positive.
#pragma once

#include <array>
#include <limits>

#include "holdfast/types.h"
#include "numbers/pair.h"
#include "optimise/tuning.h"

namespace holdfast {

inline constexpr double kNoEnergy = std::numeric_limits<double>::infinity();

/// The criteria besides the angles.
struct EnergyRule {
  double most = kNoEnergy;                       ///< the largest volume of an element, in sixths of a unit
  double hopeless_sine = tuning::kHopelessSine;  ///< q below which energies grow less steeply
  /// If positive: below hopeless_sine, energies stay below 1 + 1 / saturation times the one there.
  double saturation = 0;

  [[nodiscard]] constexpr double hopeless_q2() const { return hopeless_sine * hopeless_sine; }
  /// For hopeless elements the reciprocal of the energy is factor() * (q^2 + offset()).
  [[nodiscard]] constexpr double factor() const { return hopeless_q2() / (1 + saturation); }
  [[nodiscard]] constexpr double offset() const { return saturation * hopeless_q2(); }
};

/// The energy of an element whose least angle has this sine.
[[nodiscard]] constexpr double energy_of_sine(double q, const EnergyRule& rule = {}) {
  const double q2 = q * q;
  return 1 / (q2 < rule.hopeless_q2() ? rule.factor() * (q2 + rule.offset()) : q2 * q2);
}

/// Of one tetrahedron, or of two if Number is a Pair.
template <typename Number>
using PointOf = std::array<Number, 3>;

/// Puts into `result` the energy of each tetrahedron: infinite where it is not positive, or larger than the
/// rule allows, in floating point. No vector is handed over by value: how that is done
/// depends on what the processor is known to have.
template <typename Number>
[[gnu::always_inline]] inline void put_energy(const PointOf<Number>& a, const PointOf<Number>& b,
                                              const PointOf<Number>& c, const PointOf<Number>& d,
                                              const EnergyRule& rule, Number& result) {
  const Number ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
  const Number vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
  const Number wx = d[0] - a[0], wy = d[1] - a[1], wz = d[2] - a[2];
  const Number xx = vx - ux, xy = vy - uy, xz = vz - uz;  // bc
  const Number yx = wx - ux, yy = wy - uy, yz = wz - uz;  // bd
  const Number zx = wx - vx, zy = wy - vy, zz = wz - vz;  // cd
  // Inward normals, or all outward, of the faces opposite a, b, c, d.
  const Number ax = yy * xz - yz * xy, ay = yz * xx - yx * xz, az = yx * xy - yy * xx;
  const Number bx = vy * wz - vz * wy, by = vz * wx - vx * wz, bz = vx * wy - vy * wx;
  const Number cx = wy * uz - wz * uy, cy = wz * ux - wx * uz, cz = wx * uy - wy * ux;
  const Number dx = uy * vz - uz * vy, dy = uz * vx - ux * vz, dz = ux * vy - uy * vx;
  const Number volume = ux * bx + uy * by + uz * bz;
  const Number na = ax * ax + ay * ay + az * az, nb = bx * bx + by * by + bz * bz;
  const Number nc = cx * cx + cy * cy + cz * cz, nd = dx * dx + dy * dy + dz * dz;
  // Two divisions give the reciprocals of all four, and they are what takes time.
  const Number iab = 1 / (na * nb), icd = 1 / (nc * nd);
  const Number ia = nb * iab, ib = na * iab, ic = nd * icd, id = nc * icd;
  // Inward normals at an obtuse edge have a positive product.
  const auto put_sine2 = [](const Number& length2, const Number& i, const Number& product, Number& sine2) {
    const Number s = length2 * i, obtuse = s * tuning::kObtuse;
    sine2 = product > 0 ? obtuse : s;
  };
  Number ab, ac, ad, bc, bd, cd;
  put_sine2(ux * ux + uy * uy + uz * uz, icd, cx * dx + cy * dy + cz * dz, ab);
  put_sine2(vx * vx + vy * vy + vz * vz, ib * id, bx * dx + by * dy + bz * dz, ac);
  put_sine2(wx * wx + wy * wy + wz * wz, ib * ic, bx * cx + by * cy + bz * cz, ad);
  put_sine2(xx * xx + xy * xy + xz * xz, ia * id, ax * dx + ay * dy + az * dz, bc);
  put_sine2(yx * yx + yy * yy + yz * yz, ia * ic, ax * cx + ay * cy + az * cz, bd);
  put_sine2(zx * zx + zy * zy + zz * zz, iab, ax * bx + ay * by + az * bz, cd);
  const auto lessen = [](Number& p, const Number& q) { p = p < q ? p : q; };
  lessen(ab, ac);
  lessen(ad, bc);
  lessen(ab, ad);
  lessen(bd, cd);
  lessen(ab, bd);
  const Number& least = ab;
  const Number q2 = volume * volume * least, infinite = Number{} + kNoEnergy;
  const Number hopeless_q2 = Number{} + rule.hopeless_q2(), squared = q2 * q2;
  const Number of_hopeless = (Number{} + rule.factor()) * (q2 + (Number{} + rule.offset()));
  const Number e = 1 / (q2 < hopeless_q2 ? of_hopeless : squared), of_positive = e < infinite ? e : infinite;
  const Number of_small = volume > rule.most ? infinite : of_positive;
  result = volume > 0 ? of_small : infinite;
}

template <typename Number>
[[nodiscard]] inline Number energy(const PointOf<Number>& a, const PointOf<Number>& b,
                                   const PointOf<Number>& c, const PointOf<Number>& d,
                                   const EnergyRule& rule = {}) {
  Number result{};
  put_energy<Number>(a, b, c, d, rule, result);
  return result;
}
[[nodiscard]] inline double energy(const Point& a, const Point& b, const Point& c, const Point& d) {
  return energy<double>(a, b, c, d);
}

}  // namespace holdfast
