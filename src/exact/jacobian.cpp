#include "exact/jacobian.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "exact/dyadic.h"

namespace holdfast::exact {
namespace {

using Nodes = std::array<std::array<double, 3>, 10>;

constexpr std::size_t kCoefficients = 20;
// The node between two corners, or a corner with itself.
constexpr std::size_t kNode[4][4] = {{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3}};

/// Exponents of the barycentric coordinates in the Bernstein polynomials of degree 3, and the polynomials'
/// numbers.
struct Exponents {
  std::array<std::array<std::size_t, 4>, kCoefficients> of{};
  std::size_t number[4][4][4]{};  // by the first three

  constexpr Exponents() {
    std::size_t n = 0;
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; a + b < 4; ++b)
        for (std::size_t c = 0; a + b + c < 4; ++c) {
          of[n] = {a, b, c, 3 - a - b - c};
          number[a][b][c] = n++;
        }
  }
  [[nodiscard]] constexpr std::size_t operator()(const std::array<std::size_t, 4>& e) const {
    return number[e[0]][e[1]][e[2]];
  }
};
constexpr Exponents kExponents;

double half(double x, int times) { return std::ldexp(x, -times); }
Dyadic half(const Dyadic& x, int times) { return x.scaled(-times); }
int sign_of(double x) { return (x > 0) - (x < 0); }
int sign_of(const Dyadic& x) { return x.sign(); }

/// Bernstein coefficients, all multiplied by the same number, in doubles or exact.
template <typename Number>
using Coefficients = std::array<Number, kCoefficients>;

/// Six times the coefficients of an eighth of the determinant. Twice a control point of the map on an edge is
/// four times the node less the two corners, so every coefficient is a sum of products of coordinates.
/// `largest` gets the largest difference that is multiplied.
template <typename Number>
Coefficients<Number> coefficients_of(const Nodes& nodes, Number* largest) {
  // Relative to the first corner; otherwise differences would cancel.
  std::array<std::array<Number, 3>, 10> x;
  for (std::size_t n = 0; n < 10; ++n)
    for (std::size_t k = 0; k < 3; ++k) x[n][k] = Number(nodes[n][k]) - Number(nodes[0][k]);
  std::array<std::array<std::array<Number, 3>, 4>, 4> control;  // twice the control points
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 3; ++k)
        control[i][j][k] = i == j ? x[i][k] + x[i][k] : Number(4.0) * x[kNode[i][j]][k] - (x[i][k] + x[j][k]);
  std::array<std::array<std::array<Number, 3>, 4>, 3> d;  // columns of the Jacobian: linear in the element
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        d[c][i][k] = control[i][c + 1][k] - control[i][0][k];
        if (largest == nullptr) continue;
        const Number size = sign_of(d[c][i][k]) < 0 ? Number(0.0) - d[c][i][k] : d[c][i][k];
        if (size > *largest) *largest = size;
      }
  Coefficients<Number> sums{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const auto &u = d[0][i], &v = d[1][j];
      const std::array<Number, 3> cross{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                        u[0] * v[1] - u[1] * v[0]};
      for (std::size_t l = 0; l < 4; ++l) {
        std::array<std::size_t, 4> exponents{};
        ++exponents[i];
        ++exponents[j];
        ++exponents[l];
        const auto& w = d[2][l];
        sums[kExponents(exponents)] += cross[0] * w[0] + cross[1] * w[1] + cross[2] * w[2];
      }
    }
  constexpr double kFactorial[] = {1, 1, 2, 6};
  for (std::size_t n = 0; n < kCoefficients; ++n) {
    double weight = 1;
    for (const std::size_t e : kExponents.of[n]) weight *= kFactorial[e];
    sums[n] = Number(weight) * sums[n];
  }
  return sums;
}

/// Coefficients on the part of the element with corner `gone` moved to the middle of its edge with `stays`.
template <typename Number>
Coefficients<Number> halved(const Coefficients<Number>& of, std::size_t stays, std::size_t gone) {
  constexpr double kBinomial[4][4] = {{1, 0, 0, 0}, {1, 1, 0, 0}, {1, 2, 1, 0}, {1, 3, 3, 1}};
  Coefficients<Number> part{};
  for (std::size_t n = 0; n < kCoefficients; ++n) {
    const std::array<std::size_t, 4>& e = kExponents.of[n];
    const std::size_t s = e[gone];
    for (std::size_t t = 0; t <= s; ++t) {
      std::array<std::size_t, 4> from = e;
      from[gone] = t;
      from[stays] += s - t;
      part[n] += Number(kBinomial[s][t]) * of[kExponents(from)];
    }
    part[n] = half(part[n], static_cast<int>(s));
  }
  return part;
}

bool is_corner(std::size_t n) {
  return *std::max_element(kExponents.of[n].begin(), kExponents.of[n].end()) == 3;
}

/// Halves undecided parts along one edge after another. `error` bounds the error of a coefficient.
template <typename Number>
Jacobian decide(const Coefficients<Number>& whole, const Number& error, int most_depth) {
  struct Part {
    Coefficients<Number> coefficients;
    int depth;
  };
  constexpr std::size_t kSplit[6][2] = {{0, 1}, {2, 3}, {0, 2}, {1, 3}, {0, 3}, {1, 2}};
  constexpr std::size_t kMostParts = 4096;
  std::vector<Part> open{{whole, 0}};
  for (std::size_t looked = 0; !open.empty(); ++looked) {
    const Part part = std::move(open.back());
    open.pop_back();
    bool all_positive = true;
    for (std::size_t n = 0; n < kCoefficients; ++n) {
      if (sign_of(part.coefficients[n] - error) > 0) continue;
      all_positive = false;
      if (is_corner(n) && sign_of(part.coefficients[n] + error) <= 0) return Jacobian::not_positive;
    }
    if (all_positive) continue;
    if (part.depth == most_depth || looked > kMostParts) return Jacobian::unknown;
    const auto [a, b] = kSplit[static_cast<std::size_t>(part.depth) % 6];
    open.push_back({halved(part.coefficients, a, b), part.depth + 1});
    open.push_back({halved(part.coefficients, b, a), part.depth + 1});
  }
  return Jacobian::positive;
}

/// Decides in doubles with a bound on all rounding errors; unknown if that is not enough.
Jacobian decide_in_doubles(const Nodes& nodes) {
  constexpr double kUlp = 0x1p-52, kTiny = 0x1p-900;
  constexpr int kDepth = 18;
  double largest = 0;
  const Coefficients<double> whole = coefficients_of<double>(nodes, &largest);
  double extent = 0;
  for (const auto& node : nodes)
    for (std::size_t k = 0; k < 3; ++k) extent = std::max(extent, std::abs(node[k] - nodes[0][k]));
  // A difference d errs by at most 32 ulps of the extent: each x errs by half an ulp, and control points are
  // sums of 4 x's. In a determinant of three columns all products together err by 18 D^2 times the error of
  // d, and the sums by 12 ulps of 6 D^3. A coefficient is a sum of six determinants; halving rounds it 20
  // times.
  const double missed = 32 * kUlp * extent;
  const double d = largest + missed;
  const double error = 6 * (18 * d * d * missed + 6 * d * d * d * 12 * kUlp) + 36 * d * d * d * 160 * kUlp;
  if (!(d > kTiny) || !std::isfinite(error) || !(error > 0x1p-1000)) return Jacobian::unknown;
  return decide(whole, error, kDepth);
}

}  // namespace

Jacobian jacobian_of(const Nodes& nodes) {
  const Jacobian quick = decide_in_doubles(nodes);
  if (quick != Jacobian::unknown) return quick;
  constexpr int kDepth = 12;
  return decide(coefficients_of<Dyadic>(nodes, nullptr), Dyadic(), kDepth);
}

}  // namespace holdfast::exact
