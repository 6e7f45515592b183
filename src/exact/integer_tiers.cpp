// Integer tiers of the predicates: coordinates in a common unit, a power of two, become integers.
#include <algorithm>
#include <bit>
#include <limits>

#include "exact/determinant.h"
#include "exact/fixed_int.h"
#include "exact/tiers.h"

namespace holdfast::exact::detail {
namespace {

constexpr std::uint64_t kMagnitude = ~std::uint64_t{0} >> 1;
constexpr std::uint64_t kHiddenBit = std::uint64_t{1} << 52;

/// A double as mantissa * 2^exponent.
struct Parts {
  std::uint64_t mantissa;
  int exponent;
};

Parts parts(std::uint64_t magnitude) {
  const int field = static_cast<int>(magnitude >> 52);
  const std::uint64_t fraction = magnitude & (kHiddenBit - 1);
  return field == 0 ? Parts{fraction, -1074} : Parts{fraction | kHiddenBit, field - 1075};
}

/// An e with |x| < 2^e, from the bits of |x|.
int top_exponent(std::uint64_t magnitude) { return std::max(static_cast<int>(magnitude >> 52), 1) - 1022; }

// Headroom: coordinates below 2^(64 N - 3) have differences below 2^(64 N - 2), and with these all
// sums in the determinants fit (insphere is the tightest: squares sum to 3 * 2^(128 N - 4)).
template <std::size_t N>
constexpr int kWidth = 64 * static_cast<int>(N) - 3;

/// Doubles of one predicate call as integers in a common unit.
template <std::size_t N>
class DoubleLoader {
 public:
  /// `magnitudes`: bitwise maximum of |x| over the coordinates.
  explicit DoubleLoader(std::uint64_t magnitude) : base_(top_exponent(magnitude) - kWidth<N>) {}

  [[nodiscard]] bool usable() const { return true; }

  /// False where x is no multiple of the unit.
  [[nodiscard]] bool load(double x, FixedInt<N>& out) const {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    Parts p = parts(bits & kMagnitude);
    out = {};
    if (p.mantissa == 0) return true;
    int shift = p.exponent - base_;
    if (shift < 0) {
      if (std::countr_zero(p.mantissa) < -shift) return false;
      p.mantissa >>= -shift;
      shift = 0;
    }
    const auto word = static_cast<std::size_t>(shift) / 64;
    const int rest = shift % 64;
    out.limb[word] = p.mantissa << rest;
    if (rest > 11 && word + 1 < N) out.limb[word + 1] = p.mantissa >> (64 - rest);
    if (bits > kMagnitude) out = FixedInt<N>{} - out;
    return true;
  }

 private:
  int base_;
};

/// One limb: the floating-point unit scales and converts faster than integer code.
template <>
class DoubleLoader<1> {
 public:
  explicit DoubleLoader(std::uint64_t magnitude) : base_(top_exponent(magnitude) - kWidth<1>) {
    if (!usable()) return;
    scale_ = std::bit_cast<double>(static_cast<std::uint64_t>(1023 - base_) << 52);
    unscale_ = std::bit_cast<double>(static_cast<std::uint64_t>(1023 + base_) << 52);
  }

  /// Whether both powers of two are normal doubles.
  [[nodiscard]] bool usable() const { return base_ >= -1022 && base_ <= 1022; }

  [[nodiscard]] bool load(double x, FixedInt<1>& out) const {
    const auto integer = static_cast<std::int64_t>(x * scale_);
    out.limb[0] = static_cast<std::uint64_t>(integer);
    return static_cast<double>(integer) * unscale_ == x;  // also false where the scaling underflowed
  }

 private:
  int base_;
  double scale_ = 0;
  double unscale_ = 0;
};

template <std::size_t Dimension, std::size_t Points>
std::uint64_t max_magnitude(const std::array<const double*, Points>& points) {
  std::uint64_t result = 0;
  for (const double* p : points) {
    for (std::size_t i = 0; i < Dimension; ++i) {
      result = std::max(result, std::bit_cast<std::uint64_t>(p[i]) & kMagnitude);
    }
  }
  return result;
}

/// Rows points[i] - points[0], i >= 1, in a common unit; false where N limbs do not hold them.
template <std::size_t N, std::size_t Dimension, std::size_t Points>
bool load_rows(const std::array<const double*, Points>& points,
               std::array<std::array<FixedInt<N>, Dimension>, Points - 1>& rows) {
  const DoubleLoader<N> loader(max_magnitude<Dimension>(points));
  if (!loader.usable()) return false;
  std::array<FixedInt<N>, Dimension> origin;
  for (std::size_t i = 0; i < Dimension; ++i) {
    if (!loader.load(points[0][i], origin[i])) return false;
  }
  for (std::size_t k = 1; k < Points; ++k) {
    for (std::size_t i = 0; i < Dimension; ++i) {
      FixedInt<N> value;
      if (!loader.load(points[k][i], value)) return false;
      rows[k - 1][i] = value - origin[i];
    }
  }
  return true;
}

/// One coordinate of a point that may be exact, without copying.
class Coordinate {
 public:
  Coordinate(PointRef p, std::size_t i)
      : exact_(p.exact != nullptr ? &p.exact->c[i] : nullptr),
        bits_(std::bit_cast<std::uint64_t>(p.approx[i])) {
    if (exact_ != nullptr) {
      negative_ = exact_->sign() < 0;
      length_ = static_cast<std::int64_t>(exact_->bits());
      low_ = exact_->exponent();
    } else {
      negative_ = bits_ > kMagnitude;
      Parts p2 = parts(bits_ & kMagnitude);
      const int zeros = p2.mantissa == 0 ? 0 : std::countr_zero(p2.mantissa);
      bits_ = p2.mantissa >> zeros;
      length_ = static_cast<std::int64_t>(std::bit_width(bits_));
      low_ = p2.exponent + zeros;
    }
  }

  [[nodiscard]] bool zero() const { return length_ == 0; }
  /// |value| is an odd multiple of 2^low() and less than 2^high(). Zero has neither.
  [[nodiscard]] std::int64_t low() const { return low_; }
  [[nodiscard]] std::int64_t high() const { return low_ + length_; }

  /// value / 2^unit, for unit <= low() and high() - unit <= kWidth<N>.
  template <std::size_t N>
  [[nodiscard]] FixedInt<N> load(std::int64_t unit) const {
    FixedInt<N> out{};
    if (zero()) return out;
    const auto shift = static_cast<std::size_t>(low_ - unit);
    const std::size_t first = shift / 64;
    const std::size_t rest = shift % 64;
    const std::size_t limbs = (static_cast<std::size_t>(length_) + 63) / 64;
    for (std::size_t i = 0; i < limbs; ++i) {
      const std::uint64_t limb = exact_ != nullptr ? exact_->window(64 * i) : bits_;
      out.limb[first + i] |= limb << rest;
      if (rest != 0 && first + i + 1 < N) out.limb[first + i + 1] = limb >> (64 - rest);
    }
    return negative_ ? FixedInt<N>{} - out : out;
  }

  /// value / 2^unit, for unit <= low().
  [[nodiscard]] BigInt load_big(std::int64_t unit) const {
    if (zero()) return 0;
    BigInt out = exact_ != nullptr ? exact_->mantissa() : BigInt(bits_);
    if (exact_ == nullptr && negative_) out.backend().negate();
    out <<= static_cast<std::size_t>(low_ - unit);
    return out;
  }

 private:
  const Dyadic* exact_;
  std::uint64_t bits_;
  std::int64_t length_ = 0;
  std::int64_t low_ = 0;
  bool negative_ = false;
};

/// The range of binary digits that coordinates of one call take.
struct Span {
  std::int64_t low = std::numeric_limits<std::int64_t>::max();
  std::int64_t high = std::numeric_limits<std::int64_t>::min();
  void add(const Coordinate& c) {
    if (c.zero()) return;
    low = std::min(low, c.low());
    high = std::max(high, c.high());
  }
  [[nodiscard]] std::int64_t width() const { return high < low ? 0 : high - low; }
};

using Coordinates3 = std::array<Coordinate, 3>;
using Coordinates2 = std::array<Coordinate, 2>;

Coordinates3 coordinates(PointRef p) { return {Coordinate(p, 0), Coordinate(p, 1), Coordinate(p, 2)}; }

Coordinates2 projected(PointRef p, int axis) {
  const auto i = static_cast<std::size_t>(axis);
  return {Coordinate(p, (i + 1) % 3), Coordinate(p, (i + 2) % 3)};
}

template <class Points>
Span span_of(const Points& points) {
  Span span;
  for (const auto& p : points) {
    for (const Coordinate& c : p) span.add(c);
  }
  return span;
}

/// Rows points[i] - points[0], i >= 1, in units of 2^unit; `load(coordinate, unit)` gives the integers.
template <class Integer, std::size_t Dimension, std::size_t Points, class Load>
std::array<std::array<Integer, Dimension>, Points - 1> rows_of(
    const std::array<std::array<Coordinate, Dimension>, Points>& points, std::int64_t unit, Load load) {
  std::array<Integer, Dimension> origin;
  std::array<std::array<Integer, Dimension>, Points - 1> rows;
  for (std::size_t i = 0; i < Dimension; ++i) origin[i] = load(points[0][i], unit);
  for (std::size_t k = 1; k < Points; ++k) {
    for (std::size_t i = 0; i < Dimension; ++i) rows[k - 1][i] = load(points[k][i], unit) - origin[i];
  }
  return rows;
}

template <std::size_t N>
constexpr auto kLoadFixed = [](const Coordinate& c, std::int64_t unit) { return c.load<N>(unit); };
constexpr auto kLoadBig = [](const Coordinate& c, std::int64_t unit) { return c.load_big(unit); };

template <std::size_t N>
int fixed_orient3d(const std::array<Coordinates3, 4>& points, const Span& span) {
  const auto rows = rows_of<FixedInt<N>>(points, span.low, kLoadFixed<N>);
  return sign_det3(rows[0], rows[1], rows[2]);
}

template <std::size_t N>
int fixed_orient2d(const std::array<Coordinates2, 3>& points, const Span& span) {
  const auto rows = rows_of<FixedInt<N>>(points, span.low, kLoadFixed<N>);
  return sign_det2(rows[0], rows[1]);
}

int big_orient3d(const std::array<Coordinates3, 4>& points, const Span& span) {
  const auto rows = rows_of<BigInt>(points, span.low, kLoadBig);
  return sign_det3(rows[0], rows[1], rows[2]);
}

int big_orient2d(const std::array<Coordinates2, 3>& points, const Span& span) {
  const auto rows = rows_of<BigInt>(points, span.low, kLoadBig);
  return sign_det2(rows[0], rows[1]);
}

}  // namespace

template <std::size_t N>
std::optional<int> integer_orient3d(const double* a, const double* b, const double* c, const double* d) {
  std::array<Row<FixedInt<N>>, 3> rows;
  if (!load_rows<N, 3, 4>({a, b, c, d}, rows)) return std::nullopt;
  return sign_det3(rows[0], rows[1], rows[2]);
}

template <std::size_t N>
std::optional<int> integer_orient2d(const double* a, const double* b, const double* c) {
  std::array<std::array<FixedInt<N>, 2>, 2> rows;
  if (!load_rows<N, 2, 3>({a, b, c}, rows)) return std::nullopt;
  return sign_det2(rows[0], rows[1]);
}

template <std::size_t N>
std::optional<int> integer_insphere(const double* a, const double* b, const double* c, const double* d,
                                    const double* e) {
  std::array<Row<FixedInt<N>>, 4> rows;
  if (!load_rows<N, 3, 5>({e, a, b, c, d}, rows)) return std::nullopt;
  return sign_insphere(rows);
}

template <std::size_t N>
std::optional<int> integer_orient3d(PointRef a, PointRef b, PointRef c, PointRef d) {
  const std::array<Coordinates3, 4> points = {coordinates(a), coordinates(b), coordinates(c), coordinates(d)};
  const Span span = span_of(points);
  if (span.width() > kWidth<N>) return std::nullopt;
  return fixed_orient3d<N>(points, span);
}

template <std::size_t N>
std::optional<int> integer_orient2d(PointRef a, PointRef b, PointRef c, int axis) {
  const std::array<Coordinates2, 3> points = {projected(a, axis), projected(b, axis), projected(c, axis)};
  const Span span = span_of(points);
  if (span.width() > kWidth<N>) return std::nullopt;
  return fixed_orient2d<N>(points, span);
}

Decision decide_orient3d(PointRef a, PointRef b, PointRef c, PointRef d) {
  const std::array<Coordinates3, 4> points = {coordinates(a), coordinates(b), coordinates(c), coordinates(d)};
  const Span span = span_of(points);
  if (span.width() <= kWidth<2>) return {fixed_orient3d<2>(points, span), Tier::integer128};
  if (span.width() <= kWidth<3>) return {fixed_orient3d<3>(points, span), Tier::integer192};
  if (span.width() <= kWidth<4>) return {fixed_orient3d<4>(points, span), Tier::integer256};
  return {big_orient3d(points, span), Tier::big_integer};
}

Decision decide_orient2d(PointRef a, PointRef b, PointRef c, int axis) {
  const std::array<Coordinates2, 3> points = {projected(a, axis), projected(b, axis), projected(c, axis)};
  const Span span = span_of(points);
  if (span.width() <= kWidth<2>) return {fixed_orient2d<2>(points, span), Tier::integer128};
  if (span.width() <= kWidth<3>) return {fixed_orient2d<3>(points, span), Tier::integer192};
  if (span.width() <= kWidth<4>) return {fixed_orient2d<4>(points, span), Tier::integer256};
  return {big_orient2d(points, span), Tier::big_integer};
}

int big_orient3d(PointRef a, PointRef b, PointRef c, PointRef d) {
  const std::array<Coordinates3, 4> points = {coordinates(a), coordinates(b), coordinates(c), coordinates(d)};
  return big_orient3d(points, span_of(points));
}

int big_orient2d(PointRef a, PointRef b, PointRef c, int axis) {
  const std::array<Coordinates2, 3> points = {projected(a, axis), projected(b, axis), projected(c, axis)};
  return big_orient2d(points, span_of(points));
}

int big_insphere(const double* a, const double* b, const double* c, const double* d, const double* e) {
  const std::array<Coordinates3, 5> points = {coordinates({e}), coordinates({a}), coordinates({b}),
                                              coordinates({c}), coordinates({d})};
  return sign_insphere(rows_of<BigInt>(points, span_of(points).low, kLoadBig));
}

template std::optional<int> integer_orient3d<1>(const double*, const double*, const double*, const double*);
template std::optional<int> integer_orient3d<2>(const double*, const double*, const double*, const double*);
template std::optional<int> integer_orient2d<1>(const double*, const double*, const double*);
template std::optional<int> integer_orient2d<2>(const double*, const double*, const double*);
template std::optional<int> integer_insphere<1>(const double*, const double*, const double*, const double*,
                                                const double*);
template std::optional<int> integer_insphere<2>(const double*, const double*, const double*, const double*,
                                                const double*);
template std::optional<int> integer_orient3d<2>(PointRef, PointRef, PointRef, PointRef);
template std::optional<int> integer_orient3d<3>(PointRef, PointRef, PointRef, PointRef);
template std::optional<int> integer_orient3d<4>(PointRef, PointRef, PointRef, PointRef);
template std::optional<int> integer_orient2d<2>(PointRef, PointRef, PointRef, int);
template std::optional<int> integer_orient2d<3>(PointRef, PointRef, PointRef, int);
template std::optional<int> integer_orient2d<4>(PointRef, PointRef, PointRef, int);

}  // namespace holdfast::exact::detail
