// Integer tiers of the predicates on doubles. In a common unit, a power of two, the coordinates of most calls
// are integers of one or two limbs.
#include <algorithm>

#include "exact/determinant.h"
#include "exact/fixed_int.h"
#include "exact/float_bits.h"
#include "exact/tiers.h"
#include "numbers/float_environment.h"

namespace holdfast::exact::detail {
namespace {

/// An exponent e with |x| < 2^e, from the bits of |x|.
int top_exponent(std::uint64_t magnitude) { return std::max(static_cast<int>(magnitude >> 52), 1) - 1022; }

/// Doubles of one predicate call as integers of N limbs in a common unit.
template <std::size_t N>
class DoubleLoader {
 public:
  /// `magnitude`: the largest magnitude_bits of all coordinates.
  explicit DoubleLoader(std::uint64_t magnitude) : unit_(top_exponent(magnitude) - kFixedWidth<N>) {}

  [[nodiscard]] bool usable() const { return true; }

  /// False if x is not a multiple of the unit.
  [[nodiscard]] bool load(double x, FixedInt<N>& out) const {
    FloatParts parts = float_parts(magnitude_bits(x));
    out = {};
    if (parts.mantissa == 0) return true;
    int shift = parts.exponent - unit_;
    if (shift < 0) {
      if (std::countr_zero(parts.mantissa) < -shift) return false;
      parts.mantissa >>= -shift;
      shift = 0;
    }
    const auto word = static_cast<std::size_t>(shift) / 64;
    const int rest = shift % 64;
    out.limb[word] = parts.mantissa << rest;
    if (rest > 11 && word + 1 < N) out.limb[word + 1] = parts.mantissa >> (64 - rest);
    if (x < 0) out = -out;
    return true;
  }

 private:
  int unit_;
};

/// One limb: the floating-point unit scales and converts faster than integer code.
template <>
class DoubleLoader<1> {
 public:
  explicit DoubleLoader(std::uint64_t magnitude) : unit_(top_exponent(magnitude) - kFixedWidth<1>) {
    if (!usable()) return;
    scale_ = power_of_two(-unit_);
    unscale_ = power_of_two(unit_);
  }

  /// Whether both powers of two are normal doubles.
  [[nodiscard]] bool usable() const { return unit_ >= -1022 && unit_ <= 1022; }

  [[nodiscard]] bool load(double x, FixedInt<1>& out) const {
    const auto integer = static_cast<std::int64_t>(x * scale_);
    out.limb[0] = static_cast<std::uint64_t>(integer);
    return static_cast<double>(integer) * unscale_ == x;  // also false if the scaling underflowed
  }

 private:
  int unit_;
  double scale_ = 0;
  double unscale_ = 0;
};

template <std::size_t Dimension, std::size_t Points>
std::uint64_t max_magnitude(const std::array<const double*, Points>& points) {
  std::uint64_t result = 0;
  for (const double* p : points) {
    for (std::size_t i = 0; i < Dimension; ++i) result = std::max(result, magnitude_bits(p[i]));
  }
  return result;
}

/// Rows points[i] - points[0], i >= 1, in a common unit; false if they do not fit into N limbs.
template <std::size_t N, std::size_t Dimension, std::size_t Points>
bool load_rows(const std::array<const double*, Points>& points,
               std::array<std::array<FixedInt<N>, Dimension>, Points - 1>& rows) {
  const DoubleLoader<N> loader(max_magnitude<Dimension>(points));
  if (!loader.usable()) return false;
  std::array<FixedInt<N>, Dimension> origin;
  bool exact = true;
  for (std::size_t i = 0; i < Dimension; ++i) exact &= loader.load(points[0][i], origin[i]);
  for (std::size_t k = 1; k < Points; ++k) {
    for (std::size_t i = 0; i < Dimension; ++i) {
      FixedInt<N> value;
      exact &= loader.load(points[k][i], value);
      rows[k - 1][i] = value - origin[i];
    }
    if (!exact) return false;
  }
  return true;
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
std::optional<int> integer_incircle(const double* a, const double* b, const double* c, const double* d) {
  std::array<std::array<FixedInt<N>, 2>, 3> rows;
  if (!load_rows<N, 2, 4>({d, a, b, c}, rows)) return std::nullopt;
  return sign_incircle(rows);
}

template std::optional<int> integer_orient3d<1>(const double*, const double*, const double*, const double*);
template std::optional<int> integer_orient3d<2>(const double*, const double*, const double*, const double*);
template std::optional<int> integer_orient2d<1>(const double*, const double*, const double*);
template std::optional<int> integer_orient2d<2>(const double*, const double*, const double*);
template std::optional<int> integer_insphere<1>(const double*, const double*, const double*, const double*,
                                                const double*);
template std::optional<int> integer_insphere<2>(const double*, const double*, const double*, const double*,
                                                const double*);
template std::optional<int> integer_incircle<1>(const double*, const double*, const double*, const double*);
template std::optional<int> integer_incircle<2>(const double*, const double*, const double*, const double*);

}  // namespace holdfast::exact::detail
