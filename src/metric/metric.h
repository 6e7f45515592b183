// Algebra of metric tensors (Frey, George, Mesh Generation, 2008, chapter 10).
//
// A metric M measures a vector e as sqrt(e^T M e). A given M asks for edges of length 1 in M. Its eigenvalues
// are 1 / h^2, where h is the size along the eigenvector. The zero tensor asks for nothing.
#pragma once

#include <cmath>

#include "holdfast/types.h"

namespace holdfast {

/// The metric that measures lengths in units of `size`.
[[nodiscard]] constexpr Metric isotropic_metric(double size) {
  const double m = 1 / (size * size);
  return {m, 0, m, 0, 0, m};
}

[[nodiscard]] constexpr Metric operator*(double factor, Metric m) {
  for (double& x : m) x *= factor;
  return m;
}
[[nodiscard]] constexpr Metric operator+(Metric a, const Metric& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += b[k];
  return a;
}

/// The square of the length of a vector.
[[nodiscard]] constexpr double squared_length(const Metric& m, const std::array<double, 3>& e) {
  return m[0] * e[0] * e[0] + m[2] * e[1] * e[1] + m[5] * e[2] * e[2] +
         2 * (m[1] * e[0] * e[1] + m[3] * e[0] * e[2] + m[4] * e[1] * e[2]);
}
[[nodiscard]] inline double length(const Metric& m, const std::array<double, 3>& e) {
  return std::sqrt(squared_length(m, e));
}

/// The length of an edge with these metrics at its ends, if sizes along the edge form a geometric progression
/// (Alauzet 2010).
[[nodiscard]] double length(const Metric& a, const Metric& b, const std::array<double, 3>& e);

/// The largest size that a positive definite metric asks for in any direction.
[[nodiscard]] double largest_size(const Metric& m);

/// Whether all numbers are finite and every nonzero vector has a positive length.
[[nodiscard]] bool is_positive_definite(const Metric& m);

/// The metric whose unit ball is the largest ellipsoid that simultaneous reduction finds inside both unit
/// balls (Alauzet, Frey 2003): it measures no vector shorter than either metric does. One metric must be
/// positive definite, the other may be zero.
[[nodiscard]] Metric intersection(const Metric& a, const Metric& b);

/// The logarithm of a positive definite tensor. Metrics are interpolated by means of their logarithms: the
/// result is positive definite, and sizes along common axes have their geometric mean (Arsigny, Fillard,
/// Pennec, Ayache 2006).
[[nodiscard]] Metric logarithm(const Metric& m);
/// The exponential of any symmetric tensor: the inverse of `logarithm`.
[[nodiscard]] Metric exponential(const Metric& m);

}  // namespace holdfast
