// Tiers of the predicates on points that may be exact: fixed-width integers, then unbounded ones. The
// unbounded tier also serves doubles for which all other tiers would over- or underflow.
#include <algorithm>
#include <limits>

#include "exact/determinant.h"
#include "exact/fixed_int.h"
#include "exact/float_bits.h"
#include "exact/tiers.h"
#include "numbers/float_environment.h"

namespace holdfast::exact::detail {
namespace {

/// One coordinate of a point, as a view: +-(odd integer) * 2^low(), or zero.
class Coordinate {
 public:
  Coordinate(PointRef p, std::size_t i) : exact_(p.exact != nullptr ? &p.exact->c[i] : nullptr) {
    if (exact_ != nullptr) {
      negative_ = exact_->sign() < 0;
      length_ = exact_->bits();
      low_ = exact_->exponent();
    } else {
      const FloatParts parts = float_parts(magnitude_bits(p.approx[i]));
      const int zeros = parts.mantissa == 0 ? 0 : std::countr_zero(parts.mantissa);
      negative_ = p.approx[i] < 0;
      own_limb_ = parts.mantissa >> zeros;
      length_ = static_cast<std::size_t>(std::bit_width(own_limb_));
      low_ = parts.exponent + zeros;
    }
  }

  [[nodiscard]] bool zero() const { return length_ == 0; }
  [[nodiscard]] std::int64_t low() const { return low_; }
  /// |value| < 2^high().
  [[nodiscard]] std::int64_t high() const { return low_ + static_cast<std::int64_t>(length_); }

  /// value / 2^unit, for unit <= low() and high() - unit <= kFixedWidth<N>.
  template <std::size_t N>
  [[nodiscard]] FixedInt<N> fixed(std::int64_t unit) const {
    FixedInt<N> out{};
    if (zero()) return out;
    const auto shift = static_cast<std::size_t>(low_ - unit);
    const std::size_t first = shift / 64;
    const std::size_t rest = shift % 64;
    const Limb* limbs = exact_ != nullptr ? exact_->limbs() : &own_limb_;
    const std::size_t count = (length_ + 63) / 64;
    Limb below = 0;
    for (std::size_t i = 0; i < N - first; ++i) {
      const Limb limb = i < count ? limbs[i] : 0;
      out.limb[first + i] = rest == 0 ? limb : limb << rest | below >> (64 - rest);
      below = limb;
    }
    return negative_ ? -out : out;
  }

  /// value / 2^unit, for unit <= low().
  [[nodiscard]] BigInt big(std::int64_t unit) const {
    if (zero()) return 0;
    BigInt out = exact_ != nullptr ? exact_->mantissa() : BigInt(own_limb_);
    if (exact_ == nullptr && negative_) out.backend().negate();
    out <<= static_cast<std::size_t>(low_ - unit);
    return out;
  }

 private:
  const Dyadic* exact_;
  Limb own_limb_ = 0;
  std::size_t length_ = 0;
  std::int64_t low_ = 0;
  bool negative_ = false;
};

/// The coordinates of one predicate call and the range of their binary digits.
template <std::size_t Dimension, std::size_t Points>
class Coordinates {
 public:
  using Point = std::array<Coordinate, Dimension>;
  template <class T>
  using Rows = std::array<std::array<T, Dimension>, Points - 1>;

  explicit Coordinates(const std::array<Point, Points>& points) : points_(points) {
    for (const Point& p : points) {
      for (const Coordinate& c : p) {
        if (c.zero()) continue;
        low_ = std::min(low_, c.low());
        high_ = std::max(high_, c.high());
      }
    }
  }

  template <std::size_t N>
  [[nodiscard]] bool fit() const {
    return high_ <= low_ || high_ - low_ <= kFixedWidth<N>;
  }

  /// Rows points[i] - points[0], i >= 1, in units of the lowest digit; requires fit<N>().
  template <std::size_t N>
  [[nodiscard]] Rows<FixedInt<N>> fixed_rows() const {
    return rows<FixedInt<N>>([this](const Coordinate& c) { return c.fixed<N>(low_); });
  }

  [[nodiscard]] Rows<BigInt> big_rows() const {
    return rows<BigInt>([this](const Coordinate& c) { return c.big(low_); });
  }

 private:
  template <class T, class Load>
  [[nodiscard]] Rows<T> rows(Load load) const {
    std::array<T, Dimension> origin;
    Rows<T> result;
    for (std::size_t i = 0; i < Dimension; ++i) origin[i] = load(points_[0][i]);
    for (std::size_t k = 1; k < Points; ++k) {
      for (std::size_t i = 0; i < Dimension; ++i) result[k - 1][i] = load(points_[k][i]) - origin[i];
    }
    return result;
  }

  std::array<Point, Points> points_;
  std::int64_t low_ = std::numeric_limits<std::int64_t>::max();
  std::int64_t high_ = std::numeric_limits<std::int64_t>::min();
};

Coordinates<3, 1>::Point spatial(PointRef p) {
  return {Coordinate(p, 0), Coordinate(p, 1), Coordinate(p, 2)};
}

Coordinates<2, 1>::Point projected(PointRef p, int axis) {
  const auto i = static_cast<std::size_t>(axis);
  return {Coordinate(p, (i + 1) % 3), Coordinate(p, (i + 2) % 3)};
}

Coordinates<3, 4> four_points(PointRef a, PointRef b, PointRef c, PointRef d) {
  return Coordinates<3, 4>({spatial(a), spatial(b), spatial(c), spatial(d)});
}

Coordinates<2, 3> three_points(PointRef a, PointRef b, PointRef c, int axis) {
  return Coordinates<2, 3>({projected(a, axis), projected(b, axis), projected(c, axis)});
}

template <class T>
int sign_of(const std::array<Row<T>, 3>& rows) {
  return sign_det3(rows[0], rows[1], rows[2]);
}

template <class T>
int sign_of(const std::array<std::array<T, 2>, 2>& rows) {
  return sign_det2(rows[0], rows[1]);
}

template <std::size_t Dimension, std::size_t Points>
Decision decide(const Coordinates<Dimension, Points>& points) {
  if (points.template fit<1>()) return {sign_of(points.template fixed_rows<1>()), Tier::integer64};
  if (points.template fit<2>()) return {sign_of(points.template fixed_rows<2>()), Tier::integer128};
  if (points.template fit<3>()) return {sign_of(points.template fixed_rows<3>()), Tier::integer192};
  if (points.template fit<4>()) return {sign_of(points.template fixed_rows<4>()), Tier::integer256};
  return {sign_of(points.big_rows()), Tier::big_integer};
}

}  // namespace

Decision decide_orient3d(PointRef a, PointRef b, PointRef c, PointRef d) {
  return decide(four_points(a, b, c, d));
}

Decision decide_orient2d(PointRef a, PointRef b, PointRef c, int axis) {
  return decide(three_points(a, b, c, axis));
}

template <std::size_t N>
std::optional<int> integer_orient3d(PointRef a, PointRef b, PointRef c, PointRef d) {
  const auto points = four_points(a, b, c, d);
  if (!points.template fit<N>()) return std::nullopt;
  return sign_of(points.template fixed_rows<N>());
}

template <std::size_t N>
std::optional<int> integer_orient2d(PointRef a, PointRef b, PointRef c, int axis) {
  const auto points = three_points(a, b, c, axis);
  if (!points.template fit<N>()) return std::nullopt;
  return sign_of(points.template fixed_rows<N>());
}

int big_orient3d(PointRef a, PointRef b, PointRef c, PointRef d) {
  return sign_of(four_points(a, b, c, d).big_rows());
}

int big_orient2d(PointRef a, PointRef b, PointRef c, int axis) {
  return sign_of(three_points(a, b, c, axis).big_rows());
}

int big_insphere(const double* a, const double* b, const double* c, const double* d, const double* e) {
  const Coordinates<3, 5> points({spatial({e}), spatial({a}), spatial({b}), spatial({c}), spatial({d})});
  return sign_insphere(points.big_rows());
}

int big_incircle(const double* a, const double* b, const double* c, const double* d) {
  const auto flat = [](const double* p) {
    const double lifted[3] = {p[0], p[1], 0};  // the third coordinate only satisfies the interface
    return projected({lifted}, 2);
  };
  const Coordinates<2, 4> points({flat(d), flat(a), flat(b), flat(c)});
  return sign_incircle(points.big_rows());
}

template std::optional<int> integer_orient3d<1>(PointRef, PointRef, PointRef, PointRef);
template std::optional<int> integer_orient3d<2>(PointRef, PointRef, PointRef, PointRef);
template std::optional<int> integer_orient3d<3>(PointRef, PointRef, PointRef, PointRef);
template std::optional<int> integer_orient3d<4>(PointRef, PointRef, PointRef, PointRef);
template std::optional<int> integer_orient2d<1>(PointRef, PointRef, PointRef, int);
template std::optional<int> integer_orient2d<2>(PointRef, PointRef, PointRef, int);
template std::optional<int> integer_orient2d<3>(PointRef, PointRef, PointRef, int);
template std::optional<int> integer_orient2d<4>(PointRef, PointRef, PointRef, int);

}  // namespace holdfast::exact::detail
