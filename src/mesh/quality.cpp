#include "mesh/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace holdfast {
namespace {

using Vector = std::array<double, 3>;

Vector minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vector& a) { return std::sqrt(dot(a, a)); }

constexpr double kScale = 0.20412414523193150;  // sqrt(6) / 12

}  // namespace

double quality(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Vector ab = minus(b, a);
  const Vector ac = minus(c, a);
  const Vector ad = minus(d, a);
  const Vector bc = minus(c, b);
  const Vector bd = minus(d, b);
  const Vector cd = minus(d, c);
  const double longest =
      std::sqrt(std::max({dot(ab, ab), dot(ac, ac), dot(ad, ad), dot(bc, bc), dot(bd, bd), dot(cd, cd)}));
  const double twice_area =
      length(cross(ab, ac)) + length(cross(ab, ad)) + length(cross(ac, ad)) + length(cross(bc, bd));
  const double six_volumes = std::abs(dot(cross(ab, ac), ad));
  if (!(six_volumes > 0)) return std::numeric_limits<double>::infinity();
  return kScale * longest * twice_area / six_volumes;  // inradius = 3 V / area
}

std::array<double, 6> dihedral_angles(const Point& a, const Point& b, const Point& c, const Point& d) {
  const std::array<const Point*, 4> p{&a, &b, &c, &d};
  constexpr std::array<std::array<std::size_t, 4>, 6> kEdges{
      {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}};
  std::array<double, 6> angles{};
  for (std::size_t k = 0; k < 6; ++k) {
    const auto& e = kEdges[k];
    const Vector axis = minus(*p[e[1]], *p[e[0]]);
    const Vector n1 = cross(axis, minus(*p[e[2]], *p[e[0]]));
    const Vector n2 = cross(axis, minus(*p[e[3]], *p[e[0]]));
    // atan2 keeps its accuracy where acos of a quotient loses it, at angles near 0 and 180 degrees.
    angles[k] = std::atan2(length(cross(n1, n2)), dot(n1, n2)) * 180.0 / std::numbers::pi;
    if (!(dot(n1, n1) > 0) || !(dot(n2, n2) > 0)) angles[k] = std::numeric_limits<double>::quiet_NaN();
  }
  return angles;
}

double best_quality_on(const Point& a, const Point& b, const Point& c) {
  const std::array<double, 3> side{length(minus(c, b)), length(minus(a, c)), length(minus(b, a))};
  const double perimeter = side[0] + side[1] + side[2];
  const double area = 0.5 * length(cross(minus(b, a), minus(c, a)));
  if (!(area > 0)) return std::numeric_limits<double>::infinity();
  const double r = 2 * area / perimeter;  // inradius of the triangle
  double farthest = 0;                    // squared distance of a corner from the incentre
  for (const double s : side) {
    const double tangent = perimeter / 2 - s;
    farthest = std::max(farthest, r * r + tangent * tangent);
  }
  const double longest_side = std::max({side[0], side[1], side[2]});
  const auto at_height = [&](double z) {
    const double total_area = area + 0.5 * perimeter * std::sqrt(r * r + z * z);
    const double longest = std::max(longest_side, std::sqrt(farthest + z * z));
    return kScale * longest * total_area / (area * z);
  };
  double low = longest_side * 1e-3;  // unimodal: too flat below, too long above
  double high = longest_side * 4;
  constexpr double kGolden = 0.6180339887498949;
  for (int k = 0; k < 60; ++k) {
    const double x = high - kGolden * (high - low);
    const double y = low + kGolden * (high - low);
    (at_height(x) < at_height(y) ? high : low) = at_height(x) < at_height(y) ? y : x;
  }
  return at_height(0.5 * (low + high));
}

Report::Quality measure(const Volume& volume, std::span<const Triangle> facets) {
  Report::Quality q;
  q.min_dihedral_deg = volume.tetrahedra.empty() ? 0 : 180;
  for (const Tetrahedron& t : volume.tetrahedra) {
    const auto& v = volume.vertices;
    q.worst = std::max(q.worst, quality(v[t[0]], v[t[1]], v[t[2]], v[t[3]]));
    for (const double angle : dihedral_angles(v[t[0]], v[t[1]], v[t[2]], v[t[3]])) {
      if (std::isnan(angle)) continue;
      q.min_dihedral_deg = std::min(q.min_dihedral_deg, angle);
      q.max_dihedral_deg = std::max(q.max_dihedral_deg, angle);
      ++q.histogram[std::min<std::size_t>(17, static_cast<std::size_t>(angle / 10))];
    }
  }
  for (const Triangle& f : facets)
    q.target = std::max(q.target,
                        best_quality_on(volume.vertices[f[0]], volume.vertices[f[1]], volume.vertices[f[2]]));
  return q;
}

}  // namespace holdfast
