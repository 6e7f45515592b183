// Shapes of triangles, measured in floating point at a scale that avoids overflow and underflow.
#pragma once

#include <algorithm>
#include <cmath>

#include "numbers/elementary.h"
#include "plane/points.h"

namespace holdfast::plane {

/// Scales coordinates by a power of two, so that the largest is about 1.
class Scale {
 public:
  explicit Scale(std::span<const Position> points) {
    double most = 0;
    for (const Position& p : points) most = std::max({most, std::abs(p[0]), std::abs(p[1])});
    exponent_ = most > 0 ? std::ilogb(most) : 0;
    factor_ = std::abs(exponent_) < 1000 ? std::scalbn(1.0, -exponent_) : 0;
  }
  [[nodiscard]] Position down(const Position& p) const {
    if (factor_ != 0) [[likely]]
      return {p[0] * factor_, p[1] * factor_};
    return {std::scalbn(p[0], -exponent_), std::scalbn(p[1], -exponent_)};
  }
  [[nodiscard]] Position up(const Position& p) const {
    return {std::scalbn(p[0], exponent_), std::scalbn(p[1], exponent_)};
  }
  /// The length of a few subnormal steps; shorter edges are too fine to cut in doubles.
  [[nodiscard]] double finest() const { return std::scalbn(0x1p-1068, -exponent_); }
  [[nodiscard]] double length_down(double length) const { return std::scalbn(length, -exponent_); }
  [[nodiscard]] double area_down(double area) const {
    return std::scalbn(std::scalbn(area, -exponent_), -exponent_);
  }

 private:
  int exponent_ = 0;
  double factor_ = 0;  // 0 if it is not a normal number
};

[[nodiscard]] inline double squared(const Position& a, const Position& b) {
  const double x = a[0] - b[0], y = a[1] - b[1];
  return x * x + y * y;
}
/// The dot product of the vectors from p to a and to b.
[[nodiscard]] inline double dot_from(const Position& p, const Position& a, const Position& b) {
  return (a[0] - p[0]) * (b[0] - p[0]) + (a[1] - p[1]) * (b[1] - p[1]);
}
[[nodiscard]] inline double cross_from(const Position& p, const Position& a, const Position& b) {
  return (a[0] - p[0]) * (b[1] - p[1]) - (a[1] - p[1]) * (b[0] - p[0]);
}
[[nodiscard]] inline Position middle(const Position& a, const Position& b) {
  return {a[0] + (b[0] - a[0]) / 2, a[1] + (b[1] - a[1]) / 2};
}

/// Edge i lies opposite corner i.
struct Shape {
  Shape(const Position& a, const Position& b, const Position& c)
      : edges{squared(b, c), squared(c, a), squared(a, b)} {
    const auto least = std::min_element(edges.begin(), edges.end());
    shortest = static_cast<std::uint32_t>(least - edges.begin());
    const double p = edges[(shortest + 1) % 3], q = edges[(shortest + 2) % 3];
    cosine = (p + q - edges[shortest]) / (2 * std::sqrt(p) * std::sqrt(q));
  }
  std::array<double, 3> edges;  ///< squared lengths
  std::uint32_t shortest;
  double cosine;  ///< of the least angle, opposite the shortest edge
};

/// The least angle of triangles.
class LeastAngle {
 public:
  explicit LeastAngle(std::span<const Position> points) : scale_(points) {}

  void take(const Position& a, const Position& b, const Position& c) {
    const Position p = scale_.down(a), q = scale_.down(b), r = scale_.down(c);
    const double pq = squared(p, q), qr = squared(q, r), rp = squared(r, p);
    // Roots and quotients are computed only for triangles that may have the least angle: the shortest edge
    // has the largest cosine, n / (2 sqrt(product of the others)). No product is near underflow.
    const double shortest = std::min(std::min(pq, qr), rp), n = pq + qr + rp - 2 * shortest;
    if (n * n * shortest + 0x1p-900 < bound_ * (pq * qr * rp)) return;
    const double cosine = Shape(p, q, r).cosine;
    cosine_ = std::max(cosine_, std::isnan(cosine) ? 1 : cosine);
    bound_ = cosine_ > 0 ? 4 * (1 - 1e-12) * cosine_ * cosine_ : 0;
  }
  [[nodiscard]] double degrees() const {
    constexpr double kDegrees = 180 / 3.14159265358979323846;
    return numbers::acos(std::clamp(cosine_, -1.0, 1.0)) * kDegrees;
  }

 private:
  Scale scale_;
  double cosine_ = -1, bound_ = 0;
};

/// The circumcentre of a, b and c; not finite if they are collinear in doubles.
[[nodiscard]] inline Position circumcentre(const Position& a, const Position& b, const Position& c) {
  const double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1];
  const double twice = 2 * (bx * cy - by * cx), b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  return {a[0] + (cy * b2 - by * c2) / twice, a[1] + (bx * c2 - cx * b2) / twice};
}

}  // namespace holdfast::plane
