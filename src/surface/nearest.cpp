#include "surface/nearest.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "numbers/vector.h"

namespace holdfast {
namespace {

Point along(const Point& a, const Vector& u, double t) {
  return {a[0] + t * u[0], a[1] + t * u[1], a[2] + t * u[2]};
}

double square_distance(const Box& box, const Point& p) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double outside = std::max({box.low[k] - p[k], p[k] - box.high[k], 0.0});
    sum += outside * outside;
  }
  return sum;
}

double square_distance(const Point& a, const Point& b) {
  const Vector u = a - b;
  return dot(u, u);
}

}  // namespace

// By the Voronoi regions of the triangle's corners and sides (Ericson, Real-Time Collision Detection, 2005,
// section 5.1.5).
Point nearest_on_triangle(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Vector ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
               d6 = dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return a;
  if (d3 >= 0 && d4 <= d3) return b;
  if (d6 >= 0 && d5 <= d6) return c;
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return along(a, ab, d1 / (d1 - d3));
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return along(a, ac, d2 / (d2 - d6));
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return along(b, c - b, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double sum = va + vb + vc;
  return along(along(a, ab, vb / sum), ac, vc / sum);
}

NearestOnSurface::NearestOnSurface(std::span<const Point> vertices, std::span<const Triangle> triangles)
    : vertices_(vertices), triangles_(triangles), order_(triangles.size()) {
  std::iota(order_.begin(), order_.end(), Index{0});
  centres_.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    const Point &a = vertices[t[0]], &b = vertices[t[1]], &c = vertices[t[2]];
    centres_.push_back({a[0] + b[0] + c[0], a[1] + b[1] + c[1], a[2] + b[2] + c[2]});
  }
  if (!triangles.empty()) build(0, static_cast<Index>(triangles.size()));
}

void NearestOnSurface::build(Index first, Index count) {
  const auto box_of = [&](Index t) {
    Box box{vertices_[triangles_[t][0]], vertices_[triangles_[t][0]]};
    for (const Index v : triangles_[t]) box.extend({vertices_[v], vertices_[v]});
    return box;
  };
  const std::size_t self = nodes_.size();
  nodes_.push_back({box_of(order_[first]), first, count, 0});
  for (Index i = first; i < first + count; ++i) nodes_[self].box.extend(box_of(order_[i]));
  if (count <= kLeaf) return;
  const Box& box = nodes_[self].box;
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (box.high[k] - box.low[k] > box.high[axis] - box.low[axis]) axis = k;
  const Index left = count / 2;
  const auto at = [&](Index i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(first + left), at(first + count),
                   [&](Index x, Index y) { return centres_[x][axis] < centres_[y][axis]; });
  build(first, left);
  nodes_[self].right = static_cast<Index>(nodes_.size());
  build(first + left, count - left);
}

bool NearestOnSurface::find(const Point& p, double& distance, Point& nearest) const {
  if (nodes_.empty()) return false;
  double best = distance * distance;
  bool found = false;
  std::vector<Index> open{0};
  while (!open.empty()) {
    const Index self = open.back();
    const Node& node = nodes_[self];
    open.pop_back();
    if (square_distance(node.box, p) > best) continue;
    if (node.right != 0) {
      const Index left = self + 1, right = node.right;
      const bool left_first = square_distance(nodes_[left].box, p) <= square_distance(nodes_[right].box, p);
      open.push_back(left_first ? right : left);
      open.push_back(left_first ? left : right);
      continue;
    }
    for (Index i = node.first; i < node.first + node.count; ++i) {
      const Triangle& t = triangles_[order_[i]];
      const Point q = nearest_on_triangle(p, vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]);
      const double square = square_distance(p, q);
      if (!(square <= best)) continue;
      best = square;
      nearest = q;
      found = true;
    }
  }
  if (found) distance = std::sqrt(best);
  return found;
}

}  // namespace holdfast
