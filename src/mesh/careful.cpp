#include "mesh/careful.h"

#include <initializer_list>

#include "exact/determinant.h"
#include "exact/expansion.h"
#include "exact/point.h"

namespace holdfast::careful {
namespace {

// A sum below this part of the sum of its terms' magnitudes is computed exactly: above it, about six digits
// are left.
constexpr double kCancelled = 1e-9;

// Differences as expansions, whose products of three neither over- nor underflow (magnitudes are checked
// first), or as dyadic numbers, which have no range.
struct ByExpansions {
  using Number = exact::Expansion<2>;
  static Number minus(double a, double b) { return Number(exact::two_diff(a, b)); }
  template <typename T>
  static double to_double(const T& x) {
    return x.estimate();
  }
};
struct ByDyadics {
  using Number = exact::Dyadic;
  static Number minus(double a, double b) { return exact::Dyadic(a) - exact::Dyadic(b); }
  static double to_double(const exact::Dyadic& x) { return x.to_double(); }
};

bool suits_expansions(std::initializer_list<const Point*> points) {
  constexpr double kLeast = 1e-60, kMost = 1e60;
  return std::all_of(points.begin(), points.end(), [](const Point* p) {
    return std::all_of(p->begin(), p->end(),
                       [](double x) { return x == 0 || (std::abs(x) >= kLeast && std::abs(x) <= kMost); });
  });
}

template <typename By>
exact::Row<typename By::Number> exactly_minus(const Point& a, const Point& b) {
  return {By::minus(a[0], b[0]), By::minus(a[1], b[1]), By::minus(a[2], b[2])};
}

template <typename By>
Vector exact_normal(const Point& a, const Point& b, const Point& c) {
  const auto u = exactly_minus<By>(b, a), v = exactly_minus<By>(c, a);
  const auto minor = [&](std::size_t i, std::size_t j) { return By::to_double(u[i] * v[j] - u[j] * v[i]); };
  return {minor(1, 2), minor(2, 0), minor(0, 1)};
}

template <typename By>
double exact_six_volumes(const Point& a, const Point& b, const Point& c, const Point& d) {
  return By::to_double(
      exact::det3(exactly_minus<By>(b, a), exactly_minus<By>(c, a), exactly_minus<By>(d, a)));
}

}  // namespace

Vector normal(const Point& a, const Point& b, const Point& c) {
  const Vector u = b - a;
  const Vector v = c - a;
  Vector n{};
  double terms = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double left = u[(i + 1) % 3] * v[(i + 2) % 3];
    const double right = u[(i + 2) % 3] * v[(i + 1) % 3];
    n[i] = left - right;
    terms = std::max(terms, std::abs(left) + std::abs(right));
  }
  if (length(n) > kCancelled * terms) return n;
  return suits_expansions({&a, &b, &c}) ? exact_normal<ByExpansions>(a, b, c)
                                        : exact_normal<ByDyadics>(a, b, c);
}

double six_volumes(const Point& a, const Point& b, const Point& c, const Point& d, const Vector& n) {
  const Vector w = d - a;
  double volume = 0;
  double terms = 0;
  const Vector u = b - a;
  const Vector v = c - a;
  for (std::size_t i = 0; i < 3; ++i) {
    volume += n[i] * w[i];
    terms += (std::abs(u[(i + 1) % 3] * v[(i + 2) % 3]) + std::abs(u[(i + 2) % 3] * v[(i + 1) % 3])) *
             std::abs(w[i]);
  }
  if (std::abs(volume) > kCancelled * terms) return volume;
  return suits_expansions({&a, &b, &c, &d}) ? exact_six_volumes<ByExpansions>(a, b, c, d)
                                            : exact_six_volumes<ByDyadics>(a, b, c, d);
}

}  // namespace holdfast::careful
