#include "mesh/double_in_kernel.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "exact/integer_point.h"
#include "exact/rounding.h"

namespace holdfast {
namespace {

using exact::BigInt;
using exact::Dyadic;
using exact::ExactPoint;
using exact::IntegerHalfSpace;
using exact::IntegerVector;
using exact::Polytope;

constexpr std::int64_t kMostExponent = 971;  // of a double's last bit
constexpr std::int64_t kMantissa = 53;

BigInt shifted(const BigInt& x, std::int64_t bits) { return x << static_cast<unsigned>(bits); }

BigInt at_exponent(const Dyadic& x, std::int64_t exponent) {
  return shifted(x.mantissa(), x.sign() == 0 ? 0 : x.exponent() - exponent);
}

// a.x <= b, multiplied by the power of two that makes all its numbers integers.
IntegerHalfSpace integer_half_space(const std::array<Dyadic, 3>& a, const Dyadic& b) {
  std::int64_t least = INT64_MAX;
  for (const Dyadic* x : {&a[0], &a[1], &a[2], &b})
    if (x->sign() != 0) least = std::min(least, x->exponent());
  return {{at_exponent(a[0], least), at_exponent(a[1], least), at_exponent(a[2], least)},
          at_exponent(b, least)};
}

// A quotient of integers: x / w, w > 0.
struct Ratio {
  const BigInt& x;
  const BigInt& w;

  // floor(log2(|x| / w)); x must not be 0.
  [[nodiscard]] std::int64_t top() const {
    const BigInt magnitude = abs(x);
    const std::int64_t bits = static_cast<std::int64_t>(msb(magnitude)) - static_cast<std::int64_t>(msb(w));
    return compare(magnitude, bits) >= 0 ? bits : bits - 1;
  }
  [[nodiscard]] bool is_power(std::int64_t exponent) const { return compare(abs(x), exponent) == 0; }

 private:
  // The sign of magnitude / w - 2^exponent.
  [[nodiscard]] int compare(const BigInt& magnitude, std::int64_t exponent) const {
    return exponent >= 0 ? magnitude.compare(shifted(w, exponent)) : shifted(magnitude, -exponent).compare(w);
  }
};

Polytope::Range range_of_coordinate(const Polytope& polytope, std::size_t axis) {
  IntegerVector form{};
  form[axis] = 1;
  return polytope.range(form);
}

// The range of the kernel's coordinates among the powers of two.
struct Span {
  std::int64_t coarsest = 0, finest = 0;  // exponents of the spacing of doubles
  std::int64_t border = 0;  // 2^border is the greatest power of two inside, if the exponents differ
  bool is_border_positive = true;
};

class Search {
 public:
  Search(const TetMesh& mesh, std::span<const std::array<Vertex, 3>> faces) : grid_(mesh.grid().exponent()) {
    std::int64_t top = grid_;
    std::vector<std::array<ExactPoint, 3>> corners;
    for (const auto& f : faces) {
      corners.push_back({mesh.exact_position(f[0]), mesh.exact_position(f[1]), mesh.exact_position(f[2])});
      for (const ExactPoint& p : corners.back())
        for (const Dyadic& x : p.c)
          if (x.sign() != 0) top = std::max(top, exact::top_exponent(x));
    }
    unit_ = std::clamp(top - kMantissa, grid_, kMostExponent);
    for (const auto& c : corners) add_face(c);
  }

  DoubleSearch run() {
    // The greatest double is 2^1024 - 2^971.
    const BigInt most = shifted((BigInt(1) << static_cast<unsigned>(kMantissa)) - 1, kMostExponent - unit_);
    const std::vector<BigInt> low(3, -most), high(3, most);
    Polytope polytope(3, low, high);
    for (const IntegerHalfSpace& h : faces_) {
      polytope.cut(h);
      if (polytope.is_empty()) return {};
    }
    DoubleSearch out;
    out.point = search(polytope);
    out.is_complete = out.point.has_value() || is_complete_;
    return out;
  }

 private:
  static constexpr std::size_t kBoxSides = 6;
  static constexpr std::size_t kMostParts = 100;  // every cut makes two; few kernels cross many powers of two

  // orient(f0, f1, f2, x) = n.(x - f0), where n is the cross product of two sides; -n.x < -n.f0 is wanted.
  void add_face(const std::array<ExactPoint, 3>& f) {
    std::array<Dyadic, 3> u, v, a;
    for (std::size_t k = 0; k < 3; ++k) {
      u[k] = f[1].c[k] - f[0].c[k];
      v[k] = f[2].c[k] - f[0].c[k];
    }
    Dyadic b;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      a[k] = u[j] * v[i] - u[i] * v[j];
      b += a[k] * f[0].c[k];
      a[k] = a[k].scaled(unit_);
    }
    faces_.push_back(integer_half_space(a, b));
  }

  std::optional<Point> search(const Polytope& polytope) {
    if (polytope.is_empty()) return std::nullopt;
    if (parts_left_-- == 0) {
      parts_left_ = 0;
      is_complete_ = false;
      return std::nullopt;
    }
    std::array<Span, 3> spans;
    std::array<std::int64_t, 3> coarsest{}, finest{};
    for (std::size_t k = 0; k < 3; ++k) {
      spans[k] = span_along(polytope, k);
      coarsest[k] = spans[k].coarsest;
      finest[k] = spans[k].finest;
    }
    if (auto found = on_lattice(polytope, coarsest)) return found;
    if (coarsest == finest || !is_complete_) return std::nullopt;
    if (!on_lattice(polytope, finest) && is_complete_) return std::nullopt;
    // The search on the finest lattice need not be complete: the parts have lattices of their own.
    is_complete_ = true;
    return search_parts(polytope, spans);
  }

  // Cuts the polytope at a power of two, along the first axis whose coordinates cross one.
  std::optional<Point> search_parts(const Polytope& polytope, const std::array<Span, 3>& spans) {
    const auto axis = static_cast<std::size_t>(
        std::find_if(spans.begin(), spans.end(), [](const Span& s) { return s.coarsest != s.finest; }) -
        spans.begin());
    for (const bool outer : {true, false}) {
      Polytope part = polytope;
      part.cut(beyond_border(axis, spans[axis], outer));
      if (auto found = search(part)) return found;
      if (!is_complete_) return std::nullopt;
    }
    return std::nullopt;
  }

  [[nodiscard]] Span span_along(const Polytope& polytope, std::size_t axis) const {
    const Polytope::Range range = range_of_coordinate(polytope, axis);
    const Ratio low{range.low, range.low_divisor}, high{range.high, range.high_divisor};
    Span out{grid_, grid_, 0, true};
    if (low.x.sign() == 0 && high.x.sign() == 0) return out;
    const BigInt sum = high.x * low.w + low.x * high.w;
    out.is_border_positive = sum.sign() >= 0;
    const Ratio& far = out.is_border_positive ? high : low;
    const Ratio& near = out.is_border_positive ? low : high;
    const std::int64_t top = far.top();
    const std::int64_t border = far.is_power(top) ? top - 1 : top;  // 2^border < |far| <= 2^(border + 1)
    out.border = border + unit_;
    out.coarsest = std::max(grid_, out.border - (kMantissa - 1));
    if (near.x.sign() == far.x.sign())
      out.finest = std::min(out.coarsest, std::max(grid_, near.top() + unit_ - (kMantissa - 1)));
    return out;
  }

  // In units of 2^unit_.
  [[nodiscard]] IntegerHalfSpace beyond_border(std::size_t axis, const Span& span, bool outer) const {
    const int side = span.is_border_positive == outer ? -1 : 1;  // of the form -x <= -border or x <= border
    std::array<Dyadic, 3> a;
    a[axis] = side;
    Dyadic border = Dyadic(1).scaled(span.border - unit_);
    if (!span.is_border_positive) border = -border;
    return integer_half_space(a, border * Dyadic(side));
  }

  // A point strictly inside with coordinates u_k 2^spacing_k for integers u.
  std::optional<Point> on_lattice(const Polytope& polytope, const std::array<std::int64_t, 3>& spacing) {
    std::vector<BigInt> low(3), high(3);
    for (std::size_t k = 0; k < 3; ++k) {
      Polytope::Range range = range_of_coordinate(polytope, k);
      const std::int64_t finer = unit_ - spacing[k];
      if (finer >= 0) {
        range.low = shifted(range.low, finer);
        range.high = shifted(range.high, finer);
      } else {
        range.low_divisor = shifted(range.low_divisor, -finer);
        range.high_divisor = shifted(range.high_divisor, -finer);
      }
      low[k] = range.first();
      high[k] = range.last();
      if (low[k] > high[k]) return std::nullopt;
    }
    const exact::IntegerPointSearch found =
        exact::find_integer_point(3, low, high, faces_on_lattice(polytope, spacing));
    if (!found.is_complete) is_complete_ = false;
    if (!found.point) return std::nullopt;
    Point out{};
    for (std::size_t k = 0; k < 3; ++k) out[k] = Dyadic((*found.point)[k], spacing[k]).to_double();
    return out;
  }

  // For integers, a.u < b means a.u <= b - 1.
  [[nodiscard]] std::vector<IntegerHalfSpace> faces_on_lattice(
      const Polytope& polytope, const std::array<std::int64_t, 3>& spacing) const {
    std::vector<IntegerHalfSpace> out;
    for (const std::size_t k : polytope.touching()) {
      if (k < kBoxSides || k >= kBoxSides + faces_.size()) continue;
      const IntegerHalfSpace& h = polytope.half_spaces()[k];
      std::array<Dyadic, 3> a;
      for (std::size_t i = 0; i < 3; ++i) a[i] = Dyadic(h.a[i], spacing[i] - unit_);
      out.push_back(integer_half_space(a, Dyadic(h.b, 0)));
      --out.back().b;
    }
    return out;
  }

  std::int64_t grid_;      // no double of the mesh has a bit below 2^grid_
  std::int64_t unit_ = 0;  // the unit of the polytope's coordinates is 2^unit_
  std::vector<IntegerHalfSpace> faces_;
  std::size_t parts_left_ = kMostParts;
  bool is_complete_ = true;
};

}  // namespace

DoubleSearch find_double(const TetMesh& mesh, std::span<const std::array<Vertex, 3>> faces) {
  DoubleSearch found = Search(mesh, faces).run();
  if (!found.point) return found;
  for (const auto& f : faces)
    if (mesh.orient(f[0], f[1], f[2], {found.point->data(), nullptr}) <= 0)
      throw std::logic_error("holdfast: a double was found beside its kernel");
  return found;
}

}  // namespace holdfast
