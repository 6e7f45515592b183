#include "exact/integer_point.h"

#include <utility>
#include <vector>

namespace holdfast::exact {
namespace {

// Tightens a half-space without losing integer points: divides a by its common divisor and rounds b down.
void tighten(IntegerHalfSpace& h) {
  const BigInt divisor = gcd(gcd(h.a[0], h.a[1]), h.a[2]);
  if (divisor.sign() == 0 || divisor == 1) return;
  for (BigInt& a : h.a) a /= divisor;
  h.b = floor_of(h.b, divisor);
}

class Search {
 public:
  explicit Search(std::size_t most_planes) : planes_left_(most_planes) {}

  [[nodiscard]] bool is_complete() const { return is_complete_; }

  std::optional<IntegerVector> run(int dimension, std::span<const BigInt> low, std::span<const BigInt> high,
                                   std::vector<IntegerHalfSpace> half_spaces) {
    Polytope polytope(dimension, low, high);
    for (IntegerHalfSpace& h : half_spaces) {
      if (polytope.is_empty()) return std::nullopt;
      tighten(h);
      polytope.cut(h);
    }
    if (polytope.is_empty()) return std::nullopt;
    return dimension == 1 ? in_interval(polytope) : across_planes(dimension, polytope);
  }

 private:
  static std::optional<IntegerVector> in_interval(const Polytope& polytope) {
    const IntegerVector axis{1, 0, 0};
    const Polytope::Range range = polytope.range(axis);
    const BigInt first = range.first(), last = range.last();
    if (first > last) return std::nullopt;
    return IntegerVector{floor_of(first + last, 2), 0, 0};
  }

  // Searches in coordinates y = C x with C unimodular: fixes the last coordinate to each of its values in
  // turn.
  std::optional<IntegerVector> across_planes(int dimension, const Polytope& polytope) {
    const auto d = static_cast<std::size_t>(dimension);
    IntegerMatrix forms = reduced_basis(dimension, extent_of(polytope, d));
    std::array<BigInt, 3> first, last;
    for (std::size_t k = 0; k < d; ++k) {
      const Polytope::Range range = polytope.range(forms[k]);
      first[k] = range.first();
      last[k] = range.last();
      if (first[k] > last[k]) return std::nullopt;
    }
    std::size_t thinnest = 0;
    for (std::size_t k = 1; k < d; ++k)
      if (last[k] - first[k] < last[thinnest] - first[thinnest]) thinnest = k;
    std::swap(forms[thinnest], forms[d - 1]);
    std::swap(first[thinnest], first[d - 1]);
    std::swap(last[thinnest], last[d - 1]);
    const IntegerMatrix back = inverse_of_unimodular(dimension, forms);
    const std::vector<IntegerHalfSpace> sides = in_coordinates(polytope, back, d);
    BigInt above = floor_of(first[d - 1] + last[d - 1], 2), below = above - 1;
    while (above <= last[d - 1] || below >= first[d - 1]) {
      for (BigInt* const level : {&above, &below}) {
        if (*level > last[d - 1] || *level < first[d - 1]) continue;
        if (planes_left_ == 0) {
          is_complete_ = false;
          return std::nullopt;
        }
        --planes_left_;
        if (auto y = run(dimension - 1, first, last, on_plane(sides, d - 1, *level))) {
          (*y)[d - 1] = *level;
          return image(back, *y, d);
        }
      }
      ++above;
      --below;
    }
    return std::nullopt;
  }

  // The sum of (c.(v - v0))^2 over all vertices v, in units of 2^-kBits, is about the square of the extent
  // across c. A small multiple of c.c is added: it keeps c short where the polytope is too thin for its
  // extent to matter.
  static IntegerMatrix extent_of(const Polytope& polytope, std::size_t dimension) {
    constexpr unsigned kBits = 96, kNothing = 64;
    std::vector<IntegerVector> at;
    for (const Polytope::Vertex& v : polytope.vertices()) {
      IntegerVector x;
      for (std::size_t k = 0; k < dimension; ++k) x[k] = floor_of(v.x[k] << kBits, v.w);
      at.push_back(std::move(x));
    }
    IntegerMatrix gram{};
    for (std::size_t i = 0; i < dimension; ++i) {
      gram[i][i] = BigInt(1) << (2 * (kBits - kNothing));
      for (std::size_t j = 0; j < dimension; ++j)
        for (const IntegerVector& x : at) gram[i][j] += (x[i] - at[0][i]) * (x[j] - at[0][j]);
    }
    return gram;
  }

  static std::vector<IntegerHalfSpace> in_coordinates(const Polytope& polytope, const IntegerMatrix& back,
                                                      std::size_t dimension) {
    std::vector<IntegerHalfSpace> out;
    for (const std::size_t k : polytope.touching()) {
      const IntegerHalfSpace& h = polytope.half_spaces()[k];
      IntegerHalfSpace image{{}, h.b};
      for (std::size_t j = 0; j < dimension; ++j)
        for (std::size_t i = 0; i < dimension; ++i) image.a[j] += h.a[i] * back[i][j];
      out.push_back(std::move(image));
    }
    return out;
  }

  static std::vector<IntegerHalfSpace> on_plane(std::vector<IntegerHalfSpace> half_spaces, std::size_t axis,
                                                const BigInt& level) {
    for (IntegerHalfSpace& h : half_spaces) {
      h.b -= h.a[axis] * level;
      h.a[axis] = 0;
    }
    return half_spaces;
  }

  static IntegerVector image(const IntegerMatrix& m, const IntegerVector& y, std::size_t dimension) {
    IntegerVector x{};
    for (std::size_t i = 0; i < dimension; ++i)
      for (std::size_t j = 0; j < dimension; ++j) x[i] += m[i][j] * y[j];
    return x;
  }

  std::size_t planes_left_;
  bool is_complete_ = true;
};

}  // namespace

IntegerPointSearch find_integer_point(int dimension, std::span<const BigInt> low,
                                      std::span<const BigInt> high,
                                      std::span<const IntegerHalfSpace> half_spaces,
                                      std::size_t most_planes) {
  Search search(most_planes);
  IntegerPointSearch out;
  out.point = search.run(dimension, low, high, {half_spaces.begin(), half_spaces.end()});
  out.is_complete = out.point.has_value() || search.is_complete();
  return out;
}

}  // namespace holdfast::exact
