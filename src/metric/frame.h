// Coordinates in which a metric becomes the unit metric, so that code written for isotropic sizes also serves
// a metric.
#pragma once

#include <algorithm>

#include "metric/metric.h"

namespace holdfast {

/// An affine map of space that keeps orientation: lengths in the frame are lengths in the metric. Any root of
/// the metric would do, since roots differ by rotations only; the triangular one is the cheapest.
class Frame {
 public:
  /// The identity.
  Frame() = default;
  /// The frame of a positive definite metric, with its zero at `origin`.
  Frame(const Metric& m, const Point& origin) : is_plain_(false), origin_(origin) {
    xx_ = std::sqrt(m[0]);
    xy_ = m[1] / xx_;
    xz_ = m[3] / xx_;
    yy_ = root_of(m[2] - xy_ * xy_, m[2]);
    yz_ = (m[4] - xy_ * xz_) / yy_;
    zz_ = root_of(m[5] - xz_ * xz_ - yz_ * yz_, m[5]);
  }

  [[nodiscard]] bool is_plain() const { return is_plain_; }
  [[nodiscard]] Point to(const Point& p) const {
    if (is_plain_) return p;
    const double x = p[0] - origin_[0], y = p[1] - origin_[1], z = p[2] - origin_[2];
    return {xx_ * x + xy_ * y + xz_ * z, yy_ * y + yz_ * z, zz_ * z};
  }
  [[nodiscard]] Point from(const Point& q) const {
    if (is_plain_) return q;
    const double z = q[2] / zz_, y = (q[1] - yz_ * z) / yy_, x = (q[0] - xy_ * y - xz_ * z) / xx_;
    return {origin_[0] + x, origin_[1] + y, origin_[2] + z};
  }

 private:
  // Rounding may lose a pivot if sizes differ by eight orders of magnitude.
  static double root_of(double pivot, double diagonal) {
    constexpr double kLeast = 1e-16;
    return std::sqrt(std::max(pivot, kLeast * diagonal));
  }

  bool is_plain_ = true;
  Point origin_{};
  double xx_ = 1, xy_ = 0, xz_ = 0, yy_ = 1, yz_ = 0, zz_ = 1;  // matrix of the map
};

}  // namespace holdfast
