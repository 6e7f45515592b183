// Expansion tiers of the predicates.
#include <cmath>

#include "exact/determinant.h"
#include "exact/expansion.h"
#include "exact/tiers.h"
#include "numbers/float_environment.h"

namespace holdfast::exact::detail {
namespace {

/// Whether every non-zero coordinate lies in [least, most].
template <std::size_t Dimension, std::size_t Points>
bool magnitudes_within(const std::array<const double*, Points>& points, double least, double most) {
  for (const double* p : points) {
    for (std::size_t i = 0; i < Dimension; ++i) {
      const double size = std::fabs(p[i]);
      if (size != 0 && !(size >= least && size <= most)) return false;
    }
  }
  return true;
}

/// Rows points[i] - points[0], i >= 1.
template <std::size_t Dimension, std::size_t Points>
std::array<std::array<Expansion<2>, Dimension>, Points - 1> two_term_rows(
    const std::array<const double*, Points>& points) {
  std::array<std::array<Expansion<2>, Dimension>, Points - 1> rows;
  for (std::size_t k = 1; k < Points; ++k) {
    for (std::size_t i = 0; i < Dimension; ++i) {
      rows[k - 1][i] = Expansion<2>(two_diff(points[k][i], points[0][i]));
    }
  }
  return rows;
}

/// The same rows with one term each, if every difference is a double; else false.
template <std::size_t Dimension, std::size_t Points>
bool one_term_rows(const std::array<const double*, Points>& points,
                   std::array<std::array<Expansion<1>, Dimension>, Points - 1>& rows) {
  for (std::size_t k = 1; k < Points; ++k) {
    for (std::size_t i = 0; i < Dimension; ++i) {
      const TwoTerms difference = two_diff(points[k][i], points[0][i]);
      if (difference.low != 0) return false;
      rows[k - 1][i] = Expansion<1>(difference.high);
    }
  }
  return true;
}

}  // namespace

// Bounds of the magnitudes. A double of at least 2^k is a multiple of 2^(k - 52), and so are differences of
// such doubles. Products of n differences are multiples of 2^(n (k - 52)). If this is at least 2^-1074, all
// rounding errors are doubles. The upper bounds leave room for the sums and for the factor 2^27 of the split.

std::optional<int> expansion_orient3d(const double* a, const double* b, const double* c, const double* d) {
  const std::array<const double*, 4> points = {a, b, c, d};
  if (!magnitudes_within<3>(points, 0x1p-300, 0x1p300)) return std::nullopt;
  std::array<Row<Expansion<1>>, 3> short_rows;
  if (one_term_rows(points, short_rows)) return sign_det3(short_rows[0], short_rows[1], short_rows[2]);
  const auto rows = two_term_rows<3>(points);
  return sign_det3(rows[0], rows[1], rows[2]);
}

std::optional<int> expansion_orient2d(const double* a, const double* b, const double* c) {
  const std::array<const double*, 3> points = {a, b, c};
  if (!magnitudes_within<2>(points, 0x1p-480, 0x1p480)) return std::nullopt;
  const auto rows = two_term_rows<2>(points);
  return sign_det2(rows[0], rows[1]);
}

std::optional<int> expansion_insphere(const double* a, const double* b, const double* c, const double* d,
                                      const double* e) {
  const std::array<const double*, 5> points = {e, a, b, c, d};
  if (!magnitudes_within<3>(points, 0x1p-160, 0x1p190)) return std::nullopt;
  std::array<Row<Expansion<1>>, 4> rows;
  if (!one_term_rows(points, rows)) return std::nullopt;
  return sign_insphere(rows);
}

}  // namespace holdfast::exact::detail
