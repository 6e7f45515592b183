// Orientation among the points of a small set, in floating point.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "exact/predicates.h"
#include "numbers/pair.h"

namespace holdfast::exact {

/// orient3d among the points of a set in floating point, with one bound for all: less arithmetic than
/// OrientFilter's, several points at once, and little is left open where the set is small.
///
/// The determinant's six terms are at most V each, the product of the set's extents along the axes, and pass
/// 8 roundings, those of the differences included: the error is at most (48 + O(eps)) eps V, and 50 eps V
/// leaves 4 % for the rounding of the bound itself. Underflow: extents are below 2^250, so that all
/// underflowing roundings together err by less than 2^-800.
class OrientAmong {
 public:
  static constexpr std::size_t kMost = 32;
  struct Signs {
    std::uint32_t positive, negative;  ///< bit i: of point i
  };

  /// Of `count` <= kMost points; at(i) points to the coordinates of the i-th.
  template <typename At>
  OrientAmong(std::size_t count, At&& at) : count_(count) {
    for (std::size_t i = 0; i < count; ++i) {
      const double* const p = at(i);
      x_[i] = p[0];
      y_[i] = p[1];
      z_[i] = p[2];
    }
    if (count == 0) return;
    // What comes in pairs has no half.
    for (std::array<double, kMost>* const of : {&x_, &y_, &z_})
      if (count < kMost) (*of)[count] = (*of)[0];
    bound_ = bound(extent(x_), extent(y_), extent(z_));
  }
  /// From here on, where the extents along the axes are these, a sign is right.
  [[nodiscard]] static double bound(double x, double y, double z) {
    return x < 0x1p250 && y < 0x1p250 && z < 0x1p250 ? 50 * detail::kEpsilon * (x * y * z) + 0x1p-600
                                                     : std::numeric_limits<double>::infinity();
  }

  /// orient3d(a, b, c, d) for each d of the set, as far as it can tell.
  [[nodiscard]] Signs of_all(std::size_t a, std::size_t b, std::size_t c) const {
    const double ux = x_[b] - x_[a], uy = y_[b] - y_[a], uz = z_[b] - z_[a];
    const double vx = x_[c] - x_[a], vy = y_[c] - y_[a], vz = z_[c] - z_[a];
    const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    Signs signs{0, 0};
    const double ax = x_[a], ay = y_[a], az = z_[a];
    for (std::size_t d = 0; d < count_; d += 2) {
      const Pair determinant =
          nx * (load_pair(&x_[d]) - ax) + ny * (load_pair(&y_[d]) - ay) + nz * (load_pair(&z_[d]) - az);
      signs.positive |= bits(determinant > bound_) << d;
      signs.negative |= bits(determinant < -bound_) << d;
    }
    const std::uint32_t all = count_ == kMost ? ~std::uint32_t{0} : (std::uint32_t{1} << count_) - 1;
    signs = {signs.positive & all, signs.negative & all};
    return signs;
  }

 private:
  [[nodiscard]] double extent(const std::array<double, kMost>& of) const {
    const auto [least, most] =
        std::minmax_element(of.begin(), of.begin() + static_cast<std::ptrdiff_t>(count_));
    return *most - *least;
  }

  std::size_t count_;
  std::array<double, kMost> x_, y_, z_;
  double bound_ = 0;
};

}  // namespace holdfast::exact
