#include "surface/whereabouts.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "exact/predicates.h"

namespace holdfast {
namespace {

// Points along one coordinate, so that a facet asks for those in its range alone.
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
    return {first, last};
  }

 private:
  std::span<const Point> points_;
  std::size_t by_;
  std::vector<std::size_t> order_;
};

class Search {
 public:
  Search(const Complex& complex, std::span<const Point> points)
      : complex_(complex),
        points_(points),
        sorted_{Sorted(points, 0), Sorted(points, 1), Sorted(points, 2)},
        is_blocked_(points.size()),
        on_facet_(points.size()) {}

  // Lines along each axis: the facet's shadow along it holds the point, or not.
  void look_at(const Triangle& facet) {
    Point low = complex_.vertices[facet[0]], high = low;
    for (const Index v : facet)
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], complex_.vertices[v][k]);
        high[k] = std::max(high[k], complex_.vertices[v][k]);
      }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
      for (const std::size_t i : sorted_[x].between(low[x], high[x]))
        if (points_[i][y] >= low[y] && points_[i][y] <= high[y]) look_along(axis, facet, i);
    }
  }

  [[nodiscard]] Whereabouts of(std::size_t i) const {
    if (on_facet_[i]) return Whereabouts::on_facet;
    const auto& sides = is_blocked_[i];
    return std::find(sides.begin(), sides.end(), false) != sides.end() ? Whereabouts::unbounded
                                                                       : Whereabouts::open;
  }

 private:
  void look_along(std::size_t axis, const Triangle& facet, std::size_t i) {
    const double* const p = points_[i].data();
    const std::array<const double*, 3> c{complex_.vertices[facet[0]].data(),
                                         complex_.vertices[facet[1]].data(),
                                         complex_.vertices[facet[2]].data()};
    const auto turn = [&](const double* a, const double* b, const double* q) {
      return exact::orient2d({a, nullptr}, {b, nullptr}, {q, nullptr}, static_cast<int>(axis));
    };
    const int shadow = turn(c[0], c[1], c[2]);
    // A facet seen from its edge: what of the line it holds matters not, as it ends at facets or in the open.
    if (shadow == 0) return block_edgewise(axis, facet, i);
    for (std::size_t k = 0; k < 3; ++k)
      if (turn(c[k], c[(k + 1) % 3], p) * shadow < 0) return;
    // Along the axis, the facet's normal looks up where its shadow turns counterclockwise.
    const int above = exact::orient3d(c[0], c[1], c[2], p) * shadow;
    if (above == 0) on_facet_[i] = true;
    if (above <= 0) is_blocked_[i][2 * axis] = true;
    if (above >= 0) is_blocked_[i][2 * axis + 1] = true;
  }

  // Rather a line too many is blocked than one too few.
  void block_edgewise(std::size_t axis, const Triangle& facet, std::size_t i) {
    bool above = false, below = false;
    for (const Index v : facet) {
      above = above || complex_.vertices[v][axis] >= points_[i][axis];
      below = below || complex_.vertices[v][axis] <= points_[i][axis];
    }
    if (above) is_blocked_[i][2 * axis] = true;
    if (below) is_blocked_[i][2 * axis + 1] = true;
  }

  const Complex& complex_;
  std::span<const Point> points_;
  std::array<Sorted, 3> sorted_;
  std::vector<std::array<bool, 6>> is_blocked_;  // by point: up and down along each axis
  std::vector<bool> on_facet_;
};

}  // namespace

std::vector<Whereabouts> whereabouts(const Complex& complex, std::span<const Point> points,
                                     const std::function<void()>& step) {
  if (points.empty()) return {};
  Search search(complex, points);
  for (const Triangle& facet : complex.facets) {
    step();
    search.look_at(facet);
  }
  std::vector<Whereabouts> all(points.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = search.of(i);
  return all;
}

}  // namespace holdfast
