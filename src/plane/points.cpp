// Predicates on points, some of which are exact: a filter on their nearest doubles, then integers.
#include "plane/points.h"

#include <algorithm>
#include <cmath>

#include "exact/expansion.h"
#include "exact/tiers.h"
#include "numbers/float_environment.h"

namespace holdfast::plane {
namespace {

/// Decides incircle from doubles that err by half an ulp each, or 0.
///
/// Let M be the largest coordinate and D the largest difference. Coordinates err by eps M, so differences by
/// 2 eps M and by eps D for their rounding: x D with x = eps (2 M / D + 1). The determinant has twelve terms
/// of four differences, so this part is 12 D^4 ((1 + x)^4 - 1) at most, which is below 12 D^4 * 6 x while
/// x <= 0.2; eight more roundings of each term add 100 eps D^4.
int rough_incircle(const Position& a, const Position& b, const Position& c, const Position& d) {
  double largest = 0, extent = 0;
  for (const Position* p : {&a, &b, &c, &d})
    for (std::size_t k = 0; k < 2; ++k) {
      largest = std::max(largest, std::fabs((*p)[k]));
      extent = std::max(extent, std::fabs((*p)[k] - d[k]));
    }
  constexpr double kLeast = 0x1p-200, kMost = 0x1p200;
  if (!(extent > 0) || !(largest / extent < 0x1p45)) return 0;
  if (!(extent > kLeast && extent < kMost)) {
    // Scaling by a power of two keeps signs, except for denormals.
    const int by = -std::ilogb(extent);
    if (!(extent > 0x1p-900) || !(largest < 0x1p1000)) return 0;
    const auto scaled = [&](const Position& p) {
      return Position{std::ldexp(p[0], by), std::ldexp(p[1], by)};
    };
    return rough_incircle(scaled(a), scaled(b), scaled(c), scaled(d));
  }
  const double ax = a[0] - d[0], ay = a[1] - d[1], bx = b[0] - d[0], by = b[1] - d[1];
  const double cx = c[0] - d[0], cy = c[1] - d[1];
  const double det = (ax * ax + ay * ay) * (bx * cy - cx * by) + (bx * bx + by * by) * (cx * ay - ax * cy) +
                     (cx * cx + cy * cy) * (ax * by - bx * ay);
  const double x = exact::detail::kEpsilon * (2 * largest / extent + 1);
  const double fourth = extent * extent * extent * extent;
  return exact::detail::filtered_sign(det, (73 * x + 110 * exact::detail::kEpsilon) * fourth);
}

}  // namespace

Vertex Points::add(const Position& p) {
  positions_.push_back(p);
  return static_cast<Vertex>(positions_.size() - 1);
}

Vertex Points::add(exact::RationalPoint p) {
  const Position nearest = exact::nearest(p);
  return add(std::move(p), nearest);
}

Vertex Points::add(exact::RationalPoint p, const Position& nearest) {
  const Position rest{exact::rest_of_quotient(p.x, p.w, nearest[0]),
                      exact::rest_of_quotient(p.y, p.w, nearest[1])};
  return add(ExactPoint{std::move(p), rest}, nearest);
}

Vertex Points::add(const Points& others, Vertex v) {
  return others.is_exact(v) ? add(*others.exact_[v], others[v]) : add(others[v]);
}

Vertex Points::add(ExactPoint p, const Position& nearest) {
  const Vertex v = add(nearest);
  store_.push_back(std::move(p));
  exact_.resize(v);
  exact_.push_back(&store_.back());
  return v;
}

void Points::shrink(std::size_t count) {
  positions_.resize(count);
  while (exact_.size() > count) {
    if (exact_.back() != nullptr) store_.pop_back();
    exact_.pop_back();
  }
  if (store_.empty()) exact_.clear();
}

exact::RationalPoint Points::rational(Vertex v) const {
  return is_exact(v) ? exact_[v]->at : exact::rational_point(at(v));
}

int Points::mixed_orient(Vertex a, Vertex b, Vertex c) const {
  if (!is_exact(a) && !is_exact(b) && !is_exact(c)) return exact::orient2d(at(a), at(b), at(c));
  const int sign = exact::detail::orient2d_mixed_filter(at(a), at(b), at(c), 0, 1);
  if (sign != 0) return sign;
  const int fine = fine_orient(a, b, c);
  return fine != 0 ? fine : exact::orient2d(rational(a), rational(b), rational(c));
}

/// Decides orient from two doubles a coordinate, or returns 0: for points as near to a line as rounding puts
/// them.
///
/// Let M be the largest coordinate of an axis and D the largest difference. Coordinates err by 2^-100 M, so
/// differences, whose two roundings are below 2^-104 M each, by 2^-98 M. Four roundings of a product of two
/// doubles each err by 2^-104 of it. So the determinant errs by less than 2^-96 (Mx Dy + Dx My + Dx Dy).
int Points::fine_orient(Vertex a, Vertex b, Vertex c) const {
  std::array<exact::TwoTerms, 2> u{}, v{};
  std::array<double, 2> largest{}, extent{};
  const auto rest = [&](Vertex p, std::size_t k) { return is_exact(p) ? exact_[p]->rest[k] : 0.0; };
  const auto difference = [&](Vertex p, Vertex q, std::size_t k) {
    const exact::TwoTerms high = exact::two_diff(at(p)[k], at(q)[k]);
    return exact::two_sum(high.high, high.low + (rest(p, k) - rest(q, k)));
  };
  for (std::size_t k = 0; k < 2; ++k) {
    u[k] = difference(b, a, k);
    v[k] = difference(c, a, k);
    largest[k] = std::max({std::fabs(at(a)[k]), std::fabs(at(b)[k]), std::fabs(at(c)[k])});
    extent[k] = std::max(std::fabs(u[k].high), std::fabs(v[k].high));
  }
  constexpr double kLeast = 0x1p-300, kMost = 0x1p300;
  if (!(largest[0] < kMost && largest[1] < kMost && extent[0] > kLeast && extent[1] > kLeast)) return 0;
  const auto product = [](const exact::TwoTerms& x, const exact::TwoTerms& y) {
    const exact::TwoTerms high = exact::two_product(x.high, y.high);
    return exact::TwoTerms{high.high, high.low + (x.high * y.low + x.low * y.high)};
  };
  const exact::TwoTerms left = product(u[0], v[1]), right = product(u[1], v[0]);
  const exact::TwoTerms high = exact::two_diff(left.high, right.high);
  const double det = high.high + (high.low + (left.low - right.low));
  const double bound = 0x1p-96 * (largest[0] * extent[1] + extent[0] * largest[1] + extent[0] * extent[1]);
  return exact::detail::filtered_sign(det, bound);
}

int Points::mixed_incircle(Vertex a, Vertex b, Vertex c, Vertex d) const {
  if (!is_exact(a) && !is_exact(b) && !is_exact(c) && !is_exact(d))
    return exact::incircle(at(a), at(b), at(c), at(d));
  const int sign = rough_incircle(positions_[a], positions_[b], positions_[c], positions_[d]);
  return sign != 0 ? sign : exact::incircle(rational(a), rational(b), rational(c), rational(d));
}

bool Points::surely_in_circle(Vertex a, Vertex b, Vertex c, Vertex d) const {
  return rough_incircle(positions_[a], positions_[b], positions_[c], positions_[d]) > 0;
}

int Points::mixed_compare(Vertex a, Vertex b) const {
  if (!is_exact(a) && !is_exact(b)) return compare_positions(a, b);
  // Rounding to nearest is monotonic: rounded coordinates that differ have the order of the exact ones.
  if (positions_[a][0] != positions_[b][0]) return positions_[a][0] < positions_[b][0] ? -1 : 1;
  return exact::compare(rational(a), rational(b));
}

int Points::compare_heights(Vertex a, Vertex b, Vertex c, Vertex d) const {
  if (!is_exact(a) && !is_exact(b) && !is_exact(c) && !is_exact(d)) {
    const Position &pa = positions_[a], &pb = positions_[b], &pc = positions_[c], &pd = positions_[d];
    // The filter of orient2d. There the two differences share an origin, but its bound does not rely on that.
    const double left = (pb[0] - pa[0]) * (pd[1] - pc[1]), right = (pb[1] - pa[1]) * (pd[0] - pc[0]);
    const double bound =
        (3 + 16 * exact::detail::kEpsilon) * exact::detail::kEpsilon * (std::fabs(left) + std::fabs(right)) +
        0x1p-900;
    if (const int sign = exact::detail::filtered_sign(left - right, bound); sign != 0) return sign;
  }
  return exact::compare_heights(rational(a), rational(b), rational(c), rational(d));
}

}  // namespace holdfast::plane
