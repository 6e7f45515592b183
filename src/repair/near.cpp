#include "repair/near.h"

namespace holdfast::repairing {

Nearness beside_side(const Point& p, const Point& a, const Point& b) {
  const Vector d = b - a, w = p - a;
  const double long_d = length(d);
  Nearness near;
  near.size = std::max(long_d, length(w));
  if (!(long_d > 0)) return near;
  const Vector e = over(d, long_d);
  const double t = dot(w, e);
  if (!(t > 0) || !(t < long_d)) return near;
  near.t = t;
  near.distance = length(cross(e, w));
  for (std::size_t k = 0; k < 3; ++k) near.foot[k] = a[k] + t * e[k];
  return near;
}

Nearness beside_facet(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Vector u = b - a, v = c - a, w = p - a;
  const double size = std::max({length(u), length(v), length(w)});
  Nearness near;
  near.size = size;
  if (!(size > 0)) return near;
  const Vector us = over(u, size), vs = over(v, size), ws = over(w, size), n = cross(us, vs);
  const double nn = dot(n, n);
  if (!(nn > 0x1p-1000)) return near;
  const double t = dot(cross(ws, vs), n) / nn, s = dot(cross(us, ws), n) / nn;
  if (!(t > 0) || !(s > 0) || !(t + s < 1)) return near;
  near.distance = std::fabs(dot(ws, n)) / std::sqrt(nn) * size;
  near.tilt = size / std::sqrt(nn) * 0x1p-50;
  Vector rest{};
  for (std::size_t k = 0; k < 3; ++k) rest[k] = ws[k] - t * us[k] - s * vs[k];
  near.reach = length(rest) * size;
  for (std::size_t k = 0; k < 3; ++k) near.foot[k] = a[k] + t * u[k] + s * v[k];
  return near;
}

FarFromFacet::FarFromFacet(const Point& a, const Point& b, const Point& c, double distance) : origin_(a) {
  const Vector u = b - a, v = c - a, normal = cross(u, v);
  const double extent = length(u) + length(v), size = length(u) * length(v);
  const auto beyond = [&](const Vector& n, const Vector& at, double magnitude) {
    const double error = 0x1p-45 * magnitude;
    return Plane{n, dot(n, at) + 2 * distance * length(n) + error * extent, error};
  };
  planes_ = {beyond(normal, {}, size), beyond(Vector{} - normal, {}, size),
             beyond(cross(u, normal), {}, size * extent), beyond(cross(normal, v), {}, size * extent),
             beyond(cross(v - u, normal), u, size * extent)};
}

Passing pass(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Vector u = b - a, v = d - c, w = c - a;
  const double long_u = length(u), long_v = length(v);
  Passing passing;
  if (!(long_u > 0) || !(long_v > 0)) return passing;
  const Vector e = over(u, long_u), f = over(v, long_v), n = cross(e, f);
  const double nn = dot(n, n);
  constexpr double kParallel = 0x1p-70;  // square of an angle
  if (!(nn > kParallel)) return passing;
  const double t = dot(cross(w, f), n) / nn, s = dot(cross(w, e), n) / nn;
  if (!(t > 0) || !(t < long_u) || !(s > 0) || !(s < long_v)) return passing;
  for (std::size_t k = 0; k < 3; ++k) {
    passing.on_first[k] = a[k] + t * e[k];
    passing.on_second[k] = c[k] + s * f[k];
  }
  passing.t = t;
  passing.s = s;
  passing.distance = length(passing.on_first - passing.on_second);
  return passing;
}

double distance_above(const Point& p, const Point& a, const Point& b) {
  const double to_ends = std::min(length(p - a), length(p - b)) * (1 + 0x1p-48);
  return std::min(beside_side(p, a, b).bound(), to_ends);
}

double distance_above(const Point& p, const Point& a, const Point& b, const Point& c) {
  if (p == a || p == b || p == c) return 0;
  const double to_sides =
      std::min({distance_above(p, a, b), distance_above(p, b, c), distance_above(p, c, a)});
  return std::min(beside_facet(p, a, b, c).bound(), to_sides);
}

double distance_to(const Point& p, const Point& a, const Point& b, const Point& c) {
  double distance = beside_facet(p, a, b, c).distance;
  const auto take = [&](double d) { distance = std::min(distance, d); };
  take(beside_side(p, a, b).distance);
  take(beside_side(p, b, c).distance);
  take(beside_side(p, c, a).distance);
  for (const Point* corner : {&a, &b, &c}) take(length(p - *corner));
  return distance;
}

}  // namespace holdfast::repairing
