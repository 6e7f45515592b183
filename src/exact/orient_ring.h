// Orientation of the triangles among the corners of a ring as two ends see them, in floating point.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "exact/orient_among.h"

namespace holdfast::exact {

/// orient3d(p, q, r, end) for corners p, q, r of a ring and both ends of an axis, with one bound for all, as
/// OrientAmong has it.
class OrientRing {
 public:
  static constexpr std::size_t kMost = 20;  ///< corners

  /// at(i) points to the coordinates of the i-th corner.
  template <typename At>
  void set(std::size_t count, At&& at, const double* a, const double* b) {
    count_ = count;
    Box box(a);  // in registers
    box.take(b);
    for (std::size_t i = 0; i < count; ++i) {
      const double* const p = at(i);
      put(i + 1, p);
      box.take(p);
    }
    low_ = box.low;
    high_ = box.high;
    put(0, at(count - 1));
    put(count + 1, at(0));
    ends_ = {Pair{a[0], b[0]}, Pair{a[1], b[1]}, Pair{a[2], b[2]}};
    bound_ = OrientAmong::bound(high_[0] - low_[0], high_[1] - low_[1], high_[2] - low_[2]);
  }

  /// The box of all.
  [[nodiscard]] const std::array<double, 3>& low() const { return low_; }
  [[nodiscard]] const std::array<double, 3>& high() const { return high_; }

  struct Signs {
    std::uint32_t positive, negative;  ///< bit i: of corner i, as far as it can tell
  };
  struct OfBoth {
    Signs a, b;
  };
  /// Of each corner between the one before and the one after it.
  [[nodiscard]] OfBoth ears() const { return has_fours() ? ears_by_fours() : ears_by_pairs(); }
  /// The same on processors without fours.
  [[nodiscard]] OfBoth ears_by_pairs() const { return ears_by<Pair>(); }

  /// Of three corners: bit 0 of a, bit 1 of b.
  [[nodiscard]] Signs triangle(std::size_t i, std::size_t k, std::size_t j) const {
    const double px = at_[0][i + 1], py = at_[1][i + 1], pz = at_[2][i + 1];
    const double ux = at_[0][k + 1] - px, uy = at_[1][k + 1] - py, uz = at_[2][k + 1] - pz;
    const double vx = at_[0][j + 1] - px, vy = at_[1][j + 1] - py, vz = at_[2][j + 1] - pz;
    const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const Pair determinant = nx * (ends_[0] - px) + ny * (ends_[1] - py) + nz * (ends_[2] - pz);
    return {bits(determinant > bound_), bits(determinant < -bound_)};
  }

 private:
  struct Box {
    explicit Box(const double* p) : low{p[0], p[1], p[2]}, high(low) {}
    void take(const double* p) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = p[axis] < low[axis] ? p[axis] : low[axis];
        high[axis] = p[axis] > high[axis] ? p[axis] : high[axis];
      }
    }
    std::array<double, 3> low, high;
  };

  void put(std::size_t i, const double* p) {
    for (std::size_t axis = 0; axis < 3; ++axis) at_[axis][i] = p[axis];
  }
  HOLDFAST_WITH_FOURS [[nodiscard]] OfBoth ears_by_fours() const { return ears_by<Four>(); }
  // So many corners at once; what is beyond the last one is of former rings.
  template <typename Lanes>
  [[gnu::always_inline, nodiscard]] OfBoth ears_by() const {
    OfBoth signs{};
    for (std::size_t i = 0; i < count_; i += sizeof(Lanes) / sizeof(double)) {
      Lanes px, py, pz, ux, uy, uz, vx, vy, vz;
      load(i, px, py, pz);
      load(i + 1, ux, uy, uz);
      load(i + 2, vx, vy, vz);
      ux -= px, uy -= py, uz -= pz;
      vx -= px, vy -= py, vz -= pz;
      const Lanes nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
      const Lanes of_a = nx * (ends_[0][0] - px) + ny * (ends_[1][0] - py) + nz * (ends_[2][0] - pz);
      const Lanes of_b = nx * (ends_[0][1] - px) + ny * (ends_[1][1] - py) + nz * (ends_[2][1] - pz);
      signs.a.positive |= bits_of(of_a > bound_) << i;
      signs.a.negative |= bits_of(of_a < -bound_) << i;
      signs.b.positive |= bits_of(of_b > bound_) << i;
      signs.b.negative |= bits_of(of_b < -bound_) << i;
    }
    const std::uint32_t all = (std::uint32_t{1} << count_) - 1;
    return {{signs.a.positive & all, signs.a.negative & all},
            {signs.b.positive & all, signs.b.negative & all}};
  }
  template <typename Lanes>
  [[gnu::always_inline]] void load(std::size_t i, Lanes& x, Lanes& y, Lanes& z) const {
    std::memcpy(&x, &at_[0][i], sizeof(Lanes));
    std::memcpy(&y, &at_[1][i], sizeof(Lanes));
    std::memcpy(&z, &at_[2][i], sizeof(Lanes));
  }
  template <typename Bools>
  [[gnu::always_inline]] static std::uint32_t bits_of(const Bools& lanes) {
    if constexpr (sizeof(Bools) == sizeof(PairOfBools))
      return bits(lanes);
    else
      return bits(PairOfBools{lanes[0], lanes[1]}) | bits(PairOfBools{lanes[2], lanes[3]}) << 2;
  }

  std::size_t count_ = 0;
  std::array<std::array<double, kMost + 4>, 3> at_{};  // the last corner, all, the first
  std::array<Pair, 3> ends_{};                         // by axis: of a and b
  std::array<double, 3> low_{}, high_{};
  double bound_ = 0;
};

}  // namespace holdfast::exact
