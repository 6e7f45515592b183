// Floating-point expansions: exact sums of doubles, on the stack (Shewchuk 1997, "Adaptive precision
// floating-point arithmetic and fast robust geometric predicates", section 2; theorem numbers are his).
//
// Exact as long as nothing over- or underflows; callers check magnitudes first. Compile without
// contraction of a * b + c and without fast-math.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace holdfast::exact {

/// A sum of two doubles whose smaller one is the rounding error of the larger.
struct TwoTerms {
  double high;
  double low;
};

/// a + b exactly, |a| >= |b| or a = 0 (theorem 6, Dekker).
[[nodiscard]] inline TwoTerms fast_two_sum(double a, double b) {
  const double high = a + b;
  return {high, b - (high - a)};
}

/// a + b exactly (theorem 7, Knuth).
[[nodiscard]] inline TwoTerms two_sum(double a, double b) {
  const double high = a + b;
  const double b_virtual = high - a;
  const double a_virtual = high - b_virtual;
  return {high, (a - a_virtual) + (b - b_virtual)};
}

/// a - b exactly (theorem 7 with -b).
[[nodiscard]] inline TwoTerms two_diff(double a, double b) {
  const double high = a - b;
  const double b_virtual = a - high;
  const double a_virtual = high + b_virtual;
  return {high, (a - a_virtual) + (b_virtual - b)};
}

/// Halves of 26 bits each whose sum is a (theorem 17, Veltkamp and Dekker).
[[nodiscard]] inline TwoTerms split(double a) {
  const double shifted = 0x1.0000002p27 * a;  // 2^27 + 1
  const double high = shifted - (shifted - a);
  return {high, a - high};
}

/// a * b exactly (theorem 18, Veltkamp and Dekker).
[[nodiscard]] inline TwoTerms two_product(double a, double b) {
  const double high = a * b;
  const TwoTerms as = split(a), bs = split(b);
  const double error = ((high - as.high * bs.high) - as.low * bs.high) - as.high * bs.low;
  return {high, as.low * bs.low - error};
}

/// A nonoverlapping expansion of at most `Capacity` components, smallest first, none of them zero: the
/// zero number has no component.
template <std::size_t Capacity>
class Expansion {
 public:
  Expansion() : size_(0) {}  // the components stay uninitialised on purpose
  explicit Expansion(double value) : size_(0) { push(value); }
  explicit Expansion(TwoTerms terms) : size_(0) {
    push(terms.low);
    push(terms.high);
  }

  /// The same number with room for more.
  template <std::size_t Smaller>
  explicit Expansion(const Expansion<Smaller>& other) : size_(other.size()) {
    static_assert(Smaller <= Capacity);
    for (std::size_t i = 0; i < size_; ++i) terms_[i] = other[i];
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const double* data() const { return terms_.data(); }
  [[nodiscard]] double operator[](std::size_t i) const { return terms_[i]; }
  /// -1, 0 or +1: the largest component outweighs all others together.
  [[nodiscard]] int sign() const {
    if (size_ == 0) return 0;
    return terms_[size_ - 1] > 0 ? 1 : -1;
  }
  /// The value up to a relative error of about 2^-52.
  [[nodiscard]] double estimate() const {
    double sum = 0;
    for (std::size_t i = 0; i < size_; ++i) sum += terms_[i];
    return sum;
  }
  [[nodiscard]] Expansion operator-() const {
    Expansion result;
    for (std::size_t i = 0; i < size_; ++i) result.push(-terms_[i]);
    return result;
  }

  /// Appends a component beyond the present ones; zeros are dropped.
  void push(double term) {
    if (term != 0) terms_[size_++] = term;
  }

 private:
  std::size_t size_;
  std::array<double, Capacity> terms_;
};

/// e + f (fast expansion sum with zero elimination, theorem 13; both strongly nonoverlapping, as all
/// results of this file are).
template <std::size_t A, std::size_t B>
[[nodiscard]] Expansion<A + B> operator+(const Expansion<A>& e, const Expansion<B>& f) {
  Expansion<A + B> result;
  std::size_t i = 0, j = 0;
  // The component of smaller magnitude comes first.
  const auto next = [&] {
    if (j == f.size() || (i < e.size() && std::fabs(e[i]) < std::fabs(f[j]))) return e[i++];
    return f[j++];
  };
  const std::size_t total = e.size() + f.size();
  if (total == 0) return result;
  double sum = next();
  for (std::size_t k = 1; k < total; ++k) {
    // fast_two_sum would do for the second term only; two_sum is right for all of them.
    const TwoTerms terms = two_sum(sum, next());
    result.push(terms.low);
    sum = terms.high;
  }
  result.push(sum);
  return result;
}

template <std::size_t A, std::size_t B>
[[nodiscard]] Expansion<A + B> operator-(const Expansion<A>& e, const Expansion<B>& f) {
  return e + -f;
}

/// e * b (scale expansion with zero elimination, theorem 19).
template <std::size_t A>
[[nodiscard]] Expansion<2 * A> scale(const Expansion<A>& e, double b) {
  Expansion<2 * A> result;
  if (e.size() == 0 || b == 0) return result;
  TwoTerms product = two_product(e[0], b);
  result.push(product.low);
  double sum = product.high;
  for (std::size_t i = 1; i < e.size(); ++i) {
    product = two_product(e[i], b);
    const TwoTerms lower = two_sum(sum, product.low);
    result.push(lower.low);
    const TwoTerms upper = fast_two_sum(product.high, lower.high);
    result.push(upper.low);
    sum = upper.high;
  }
  result.push(sum);
  return result;
}

namespace detail {

/// e times the expansion of `count` <= B components at f, whose halves are summed recursively
/// (distillation, section 2.8); that keeps the sums short.
template <std::size_t B, std::size_t A>
[[nodiscard]] Expansion<2 * A * B> multiply(const Expansion<A>& e, const double* f, std::size_t count) {
  if constexpr (B == 1) {
    return scale(e, count == 0 ? 0.0 : f[0]);
  } else {
    constexpr std::size_t kHalf = B / 2;
    if (count <= kHalf) return Expansion<2 * A * B>(multiply<kHalf>(e, f, count));
    return multiply<kHalf>(e, f, kHalf) + multiply<B - kHalf>(e, f + kHalf, count - kHalf);
  }
}

}  // namespace detail

/// e * f.
template <std::size_t A, std::size_t B>
[[nodiscard]] Expansion<2 * A * B> operator*(const Expansion<A>& e, const Expansion<B>& f) {
  return detail::multiply<B>(e, f.data(), f.size());
}

}  // namespace holdfast::exact
