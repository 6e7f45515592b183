#include "size/facet_sizes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numbers/vector.h"
#include "size/tuning.h"

namespace holdfast {
namespace {

constexpr std::uint32_t kLeaf = 4;

double square(double x) { return x * x; }

double distance2_to_box(const Point& x, const Point& low, const Point& high) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += square(std::max({low[k] - x[k], 0.0, x[k] - high[k]}));
  return sum;
}

double distance2_to_side(const Point& x, const Point& a, const Point& b) {
  const Vector u = b - a, w = x - a;
  const double uu = dot(u, u);
  const double t = uu > 0 ? std::clamp(dot(u, w) / uu, 0.0, 1.0) : 0.0;
  const Vector r{w[0] - t * u[0], w[1] - t * u[1], w[2] - t * u[2]};
  return dot(r, r);
}

// To a triangle: over its inside to the plane, else to the nearest side.
double distance_to(const Point& x, const std::array<Point, 3>& t) {
  const Vector n = cross(t[1] - t[0], t[2] - t[0]);
  bool inside = true;
  for (std::size_t k = 0; k < 3 && inside; ++k) {
    const Point &a = t[k], &b = t[(k + 1) % 3];
    inside = dot(n, cross(b - a, x - a)) >= 0;
  }
  if (const double nn = dot(n, n); inside && nn > 0) return std::abs(dot(n, x - t[0])) / std::sqrt(nn);
  return std::sqrt(std::min({distance2_to_side(x, t[0], t[1]), distance2_to_side(x, t[1], t[2]),
                             distance2_to_side(x, t[2], t[0])}));
}

double longest_side(const std::array<Point, 3>& t) {
  return std::max({distance(t[0], t[1]), distance(t[1], t[2]), distance(t[2], t[0])});
}

}  // namespace

FacetSizes::FacetSizes(std::span<const Facet> facets, Wanted wanted) : wanted_(wanted) {
  for (const Facet& f : facets) {
    const double need = tuning::kNeedOfFacet * longest_side(f.corners);
    if (need > tuning::kFarBeyond * f.wanted || wanted == Wanted::anywhere)
      facets_.push_back({f.corners, std::min(need, tuning::kMostNeed * f.wanted)});
  }
  if (facets_.empty()) return;
  nodes_.push_back({{}, {}, 0, 0, static_cast<std::uint32_t>(facets_.size()), 0});
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) build(node);
}

// Parts a node in the middle of its facets along its longest extent.
void FacetSizes::build(std::uint32_t node) {
  Node n = nodes_[node];
  n.low.fill(std::numeric_limits<double>::infinity());
  n.high.fill(-std::numeric_limits<double>::infinity());
  const auto first = facets_.begin() + n.first, last = first + n.count;
  for (auto f = first; f != last; ++f) {
    n.need = std::max(n.need, f->need);
    for (const Point& p : f->corners)
      for (std::size_t k = 0; k < 3; ++k) {
        n.low[k] = std::min(n.low[k], p[k]);
        n.high[k] = std::max(n.high[k], p[k]);
      }
  }
  if (n.count > kLeaf) {
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (n.high[k] - n.low[k] > n.high[axis] - n.low[axis]) axis = k;
    const auto place = [axis](const Held& f) {
      return f.corners[0][axis] / 3 + f.corners[1][axis] / 3 + f.corners[2][axis] / 3;
    };
    std::stable_sort(first, last, [&](const Held& f, const Held& g) { return place(f) < place(g); });
    n.left = static_cast<std::uint32_t>(nodes_.size());
    const std::uint32_t half = n.count / 2;
    nodes_.push_back({{}, {}, 0, n.first, half, 0});
    nodes_.push_back({{}, {}, 0, n.first + half, n.count - half, 0});
  }
  nodes_[node] = n;
}

template <typename Act>
void FacetSizes::for_each_near(const Point& x, double rate, const double& size, Act&& act) const {
  if (nodes_.empty()) return;
  std::array<std::uint32_t, 64> stack{};
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& n = nodes_[stack[--depth]];
    if (!(n.need > size) || square(n.need - size) <= square(rate) * distance2_to_box(x, n.low, n.high))
      continue;
    if (n.left != 0) {
      stack[depth++] = n.left;
      stack[depth++] = n.left + 1;
      continue;
    }
    for (std::uint32_t k = n.first; k < n.first + n.count; ++k) {
      const Held& f = facets_[k];
      if (f.need > size && !act(f, distance_to(x, f.corners))) return;
    }
  }
}

double FacetSizes::most_need(double size) const {
  return wanted_ == Wanted::anywhere ? tuning::kMostNeed * size : std::numeric_limits<double>::infinity();
}

double FacetSizes::bearable(const Point& x, double size) const {
  const double most = most_need(size), least = wanted_ == Wanted::anywhere ? tuning::kFarBeyond * size : 0;
  for_each_near(x, tuning::kFallOfNeed, size, [&](const Held& f, double distance) {
    if (f.need > least) size = std::max(size, std::min(f.need, most) - tuning::kFallOfNeed * distance);
    return true;
  });
  return size;
}

bool FacetSizes::is_too_near(const Point& x, double size) const {
  constexpr double part = tuning::kLeastClearance;
  const double most = most_need(size), least = wanted_ == Wanted::anywhere ? tuning::kFarBeyond * size : 0;
  bool is_near = false;
  for_each_near(x, tuning::kFallOfNeed + 1 / part, 0, [&](const Held& f, double distance) {
    const double need = f.need > least ? std::min(f.need, most) : 0;
    is_near = distance < part * (need - tuning::kFallOfNeed * distance);
    return !is_near;
  });
  return is_near;
}

}  // namespace holdfast
