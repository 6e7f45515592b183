// References and point generators for the tests of the exact module. The references are general
// rationals (boost cpp_rational), an arithmetic that the product does not use.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "exact/point.h"

namespace holdfast::exact::test {

using Rational = boost::multiprecision::cpp_rational;
using Integer = boost::multiprecision::cpp_int;
using Point3 = std::array<double, 3>;
using Random = std::mt19937_64;

/// value * 2^exponent.
inline Rational scaled(const Rational& value, std::int64_t exponent) {
  const Rational power(Integer(1) << static_cast<std::size_t>(exponent < 0 ? -exponent : exponent));
  return exponent < 0 ? Rational(value / power) : Rational(value * power);
}

inline Rational rational(double x) {
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  return scaled(Rational(static_cast<std::int64_t>(std::ldexp(fraction, 53))), exponent - 53);
}

inline Rational rational(const Dyadic& x) { return scaled(Rational(Integer(x.mantissa())), x.exponent()); }

using RationalPoint = std::array<Rational, 3>;

inline RationalPoint rational(PointRef p) {
  RationalPoint result;
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = p.exact != nullptr ? rational(p.exact->c[i]) : rational(p.approx[i]);
  }
  return result;
}

inline RationalPoint minus(const RationalPoint& a, const RationalPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline RationalPoint cross(const RationalPoint& a, const RationalPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Rational dot(const RationalPoint& a, const RationalPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Rational det(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
  return dot(a, cross(b, c));
}

inline int sign(const Rational& x) { return x.sign(); }

inline int reference_orient3d(PointRef a, PointRef b, PointRef c, PointRef d) {
  const RationalPoint o = rational(a);
  return sign(det(minus(rational(b), o), minus(rational(c), o), minus(rational(d), o)));
}

inline int reference_orient2d(PointRef a, PointRef b, PointRef c, int axis) {
  const RationalPoint o = rational(a);
  return sign(cross(minus(rational(b), o), minus(rational(c), o))[static_cast<std::size_t>(axis)]);
}

/// The determinant of the lifted differences, for any five points.
inline int reference_insphere(const Point3& a, const Point3& b, const Point3& c, const Point3& d,
                              const Point3& e) {
  const auto lifted = [&e](const Point3& p) {
    return minus(rational(PointRef{p.data()}), rational(PointRef{e.data()}));
  };
  const RationalPoint u = lifted(a), v = lifted(b), w = lifted(c), x = lifted(d);
  return sign(dot(w, w) * det(x, u, v) - dot(x, x) * det(u, v, w) + dot(u, u) * det(v, w, x) -
              dot(v, v) * det(w, x, u));
}

/// The same from the centre of the sphere: |e - o|^2 against |a - o|^2, times the orientation. The four
/// points must not be coplanar.
inline int reference_insphere_by_centre(const Point3& a, const Point3& b, const Point3& c, const Point3& d,
                                        const Point3& e) {
  const RationalPoint origin = rational(PointRef{a.data()});
  const auto relative = [&origin](const Point3& p) { return minus(rational(PointRef{p.data()}), origin); };
  const RationalPoint u = relative(b), v = relative(c), w = relative(d), x = relative(e);
  const Rational volume = det(u, v, w);
  const RationalPoint vw = cross(v, w), wu = cross(w, u), uv = cross(u, v);
  RationalPoint centre;
  for (std::size_t i = 0; i < 3; ++i) {
    centre[i] = (dot(u, u) * vw[i] + dot(v, v) * wu[i] + dot(w, w) * uv[i]) / (2 * volume);
  }
  return sign(2 * dot(centre, x) - dot(x, x)) * sign(volume);
}

/// Five points, and what kind of case they are.
struct Case {
  std::string kind;
  std::array<Point3, 5> p;
};

inline double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline int integer(Random& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

/// Moves some coordinates by one ulp.
inline void jitter(Random& random, std::array<Point3, 5>& points) {
  for (Point3& p : points) {
    for (double& x : p) {
      const int step = integer(random, -3, 3);
      if (step == 1) x = std::nextafter(x, HUGE_VAL);
      if (step == -1) x = std::nextafter(x, -HUGE_VAL);
    }
  }
}

/// A random generator of five points: nearly degenerate ones above all.
inline Case random_case(Random& random) {
  Case result;
  const auto fill = [&](const char* kind, auto coordinate) {
    result.kind = kind;
    for (Point3& p : result.p) {
      for (double& x : p) x = coordinate();
    }
  };
  // Vertices of a cube, a box or an octahedron: cospherical, and often coplanar.
  const auto cospherical = [&](double unit, double offset) {
    static constexpr int kPoints[][3] = {{1, 2, 2}, {2, 1, 2}, {2, 2, 1}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}};
    for (Point3& p : result.p) {
      const auto& q = kPoints[integer(random, 0, 5)];
      for (std::size_t i = 0; i < 3; ++i) p[i] = offset + (integer(random, 0, 1) == 0 ? q[i] : -q[i]) * unit;
    }
  };
  switch (integer(random, 0, 16)) {
    case 0:
      fill("uniform", [&] { return uniform(random, -1, 1); });
      break;
    case 1:
      fill("small grid", [&] { return integer(random, 0, 3); });
      break;
    case 2:
      fill("decimal grid", [&] { return 0.1 * integer(random, -4, 4); });
      break;
    case 3:
      fill("float32", [&] { return static_cast<float>(uniform(random, -1, 1)); });
      break;
    case 4:
      fill("huge", [&] { return uniform(random, -1, 1) * 1e300; });
      break;
    case 5:
      fill("tiny", [&] { return uniform(random, -1, 1) * 1e-300; });
      break;
    case 6:
      fill("denormal", [&] { return integer(random, -9, 9) * 0x1p-1074; });
      break;
    case 7:
      fill("mixed exponents", [&] { return std::ldexp(uniform(random, -1, 1), integer(random, -60, 60)); });
      break;
    case 8:
      fill("any exponent", [&] { return std::ldexp(integer(random, -9, 9), integer(random, -1074, 1018)); });
      break;
    case 9:
      fill("extremes", [&] {
        static constexpr double kValues[] = {0,       0x1p-1074, 1, 0x1p-1022, 0x1.fffffffffffffp1023,
                                             0x1p511, 0x1p-540};
        const double value = kValues[integer(random, 0, 6)];
        return integer(random, 0, 1) == 0 ? value : -value;
      });
      break;
    case 10:
      result.kind = "coplanar by rounding";
      for (Point3& p : result.p) {
        p[0] = uniform(random, 0, 1);
        p[1] = uniform(random, 0, 1);
        p[2] = 0.5 * p[0] + 0.25 * p[1];
      }
      jitter(random, result.p);
      break;
    case 11:
      result.kind = "cospherical";
      cospherical(1, 0);
      break;
    case 12:
      result.kind = "cospherical moved by an ulp";
      cospherical(0.1, integer(random, 0, 100));
      jitter(random, result.p);
      break;
    case 13:
      // Degree five: products near the least double, or near the largest.
      result.kind = "cospherical at 2^-214 or 2^200";
      cospherical(integer(random, 0, 2) == 0 ? 0x1p200 : std::ldexp(1.0, integer(random, -218, -208)), 0);
      jitter(random, result.p);
      break;
    case 15:
      result.kind = "collinear by rounding";
      for (Point3& p : result.p) {
        const double t = uniform(random, -1, 1);
        p = {0.1 + 0.3 * t, 0.7 - 0.9 * t, 0.2 + 1.1 * t};
      }
      jitter(random, result.p);
      break;
    case 14:
      fill("wide about the origin", [&] {
        return integer(random, 0, 2) == 0 ? 0 : std::ldexp(integer(random, -3, 3), integer(random, -99, 99));
      });
      result.p[4] = {0, 0, 0};
      break;
    default:
      // Products of x and y underflow, and z would magnify what is left of them.
      result.kind = "underflow times overflow";
      for (Point3& p : result.p) {
        p[0] = std::ldexp(uniform(random, -1, 1), integer(random, -545, -525));
        p[1] = std::ldexp(uniform(random, -1, 1), integer(random, -545, -525));
        p[2] = std::ldexp(uniform(random, -1, 1), integer(random, 880, 1023));
      }
  }
  return result;
}

/// An exact point a + t (b - a) with t a binary fraction of about `bits` bits, and its doubles.
struct MadePoint {
  ExactPoint exact;
  Point3 approx;
  [[nodiscard]] PointRef ref() const { return {approx.data(), &exact}; }
};

inline void round(MadePoint& p) {
  for (std::size_t i = 0; i < 3; ++i) p.approx[i] = p.exact.c[i].to_double();
}

inline Dyadic random_fraction(Random& random, int bits) {
  Dyadic t;
  for (int done = 0; done < bits; done += 32) {
    t += Dyadic(static_cast<double>(random() >> 32 | 1)).scaled(-done - 32);
  }
  return t;
}

inline MadePoint between(const Point3& a, const Point3& b, const Dyadic& t) {
  MadePoint result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.exact.c[i] = Dyadic(a[i]) + t * (Dyadic(b[i]) - Dyadic(a[i]));
  }
  round(result);
  return result;
}

/// a + u (b - a) + v (c - a).
inline MadePoint in_plane(const Point3& a, const Point3& b, const Point3& c, const Dyadic& u,
                          const Dyadic& v) {
  MadePoint result;
  for (std::size_t i = 0; i < 3; ++i) {
    const Dyadic origin(a[i]);
    result.exact.c[i] = origin + u * (Dyadic(b[i]) - origin) + v * (Dyadic(c[i]) - origin);
  }
  round(result);
  return result;
}

}  // namespace holdfast::exact::test
