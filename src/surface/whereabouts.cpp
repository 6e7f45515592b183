#include "surface/whereabouts.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "exact/predicates.h"

namespace holdfast {
namespace {

// Points sorted along one coordinate, so that a facet examines only those in its range.
class Sorted {
 public:
  Sorted(std::span<const Point> points, std::size_t by) : points_(points), by_(by), order_(points.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::sort(order_.begin(), order_.end(),
              [&](std::size_t i, std::size_t j) { return points[i][by] < points[j][by]; });
  }
  [[nodiscard]] std::span<const std::size_t> between(double low, double high) const {
    const auto first = std::lower_bound(order_.begin(), order_.end(), low,
                                        [&](std::size_t i, double x) { return points_[i][by_] < x; });
    const auto last = std::upper_bound(first, order_.end(), high,
                                       [&](double x, std::size_t i) { return x < points_[i][by_]; });
    return std::span(order_).subspan(static_cast<std::size_t>(first - order_.begin()),
                                     static_cast<std::size_t>(last - first));
  }

 private:
  std::span<const Point> points_;
  std::size_t by_;
  std::vector<std::size_t> order_;
};

// Shoots lines up along the last axis, moved by (e, e^2) for an infinitesimal positive e, so that they meet
// no side and no facet seen edge-on (Edelsbrunner and Mücke 1990).
class PlaceSearch {
 public:
  PlaceSearch(const Complex& complex, std::span<const Point> points)
      : complex_(complex),
        points_(points),
        sorted_(points, 0),
        on_facet_(points.size()),
        crossed_(points.size()) {}

  void look_at(Index f) {
    Point low = complex_.vertices[complex_.facets[f][0]], high = low;
    for (const Index v : complex_.facets[f])
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], complex_.vertices[v][k]);
        high[k] = std::max(high[k], complex_.vertices[v][k]);
      }
    const Corners corners = corners_of(f);
    for (const std::size_t i : sorted_.between(low[0], high[0])) {
      const Point& p = points_[i];
      if (p[1] < low[1] || p[1] > high[1] || p[2] > high[2]) continue;
      if (p[2] >= low[2] && holds(corners, p.data())) on_facet_[i] = true;
      if (is_crossed(corners, p.data())) crossed_[i].push_back(f);
    }
  }

  [[nodiscard]] bool on_facet(std::size_t i) const { return on_facet_[i]; }
  [[nodiscard]] std::span<const Index> crossed(std::size_t i) const { return crossed_[i]; }

 private:
  using Corners = std::array<const double*, 3>;

  [[nodiscard]] Corners corners_of(Index f) const {
    const Triangle& t = complex_.facets[f];
    return {complex_.vertices[t[0]].data(), complex_.vertices[t[1]].data(), complex_.vertices[t[2]].data()};
  }

  static int turn(const double* a, const double* b, const double* p, int axis) {
    return exact::orient2d({a, nullptr}, {b, nullptr}, {p, nullptr}, axis);
  }

  // Whether p is in the facet's plane, and in its projection along an axis not parallel to that plane.
  static bool holds(const Corners& c, const double* p) {
    for (int axis = 0; axis < 3; ++axis) {
      const int shadow = turn(c[0], c[1], c[2], axis);
      if (shadow == 0) continue;
      for (std::size_t k = 0; k < 3; ++k)
        if (turn(c[k], c[(k + 1) % 3], p, axis) * shadow < 0) return false;
      return exact::orient3d(c[0], c[1], c[2], p) == 0;
    }
    return false;
  }

  // The sign of the turn; if it is zero, of its derivative by p's first coordinate, then by its second.
  static int turn_of_moved(const double* a, const double* b, const double* p) {
    if (const int sign = turn(a, b, p, 2); sign != 0) return sign;
    if (a[1] != b[1]) return a[1] > b[1] ? 1 : -1;
    return a[0] < b[0] ? 1 : -1;
  }

  // The facet's normal points up if its projection turns counterclockwise.
  static bool is_crossed(const Corners& c, const double* p) {
    const int shadow = turn(c[0], c[1], c[2], 2);
    if (shadow == 0) return false;
    for (std::size_t k = 0; k < 3; ++k)
      if (turn_of_moved(c[k], c[(k + 1) % 3], p) * shadow < 0) return false;
    return exact::orient3d(c[0], c[1], c[2], p) * shadow < 0;
  }

  const Complex& complex_;
  std::span<const Point> points_;
  Sorted sorted_;
  std::vector<bool> on_facet_;               // by point
  std::vector<std::vector<Index>> crossed_;  // by point: the facets above it
};

}  // namespace

std::vector<Whereabouts> whereabouts(const Complex& complex, const Separation& separation,
                                     std::span<const Point> points, const std::function<void()>& step) {
  PlaceSearch search(complex, points);
  for (Index f = 0; f < complex.facets.size(); ++f) {
    step();
    search.look_at(f);
  }
  std::vector<Whereabouts> all(points.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = {search.on_facet(i), separation.beyond(search.crossed(i))};
  return all;
}

}  // namespace holdfast
