// The least distance between two sets of triangles: a best-first search through two trees of boxes, which
// ends when no pair of boxes is nearer than the best pair found.
#include "api/part_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>

#include "numbers/elementary.h"
#include "numbers/vector.h"
#include "surface/aabb_tree.h"

namespace holdfast {
namespace {

Point along(const Point& a, const Vector& u, double t) {
  return {a[0] + t * u[0], a[1] + t * u[1], a[2] + t * u[2]};
}
double distance(const Point& a, const Point& b) {
  return numbers::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// The nearest points of two segments (Ericson, Real-Time Collision Detection, 5.1.9).
std::array<Point, 2> between_sides(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Vector u = b - a, v = d - c, w = a - c;
  const double uu = dot(u, u), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w), uv = dot(u, v);
  const auto inside = [](double t) { return std::isfinite(t) ? std::clamp(t, 0.0, 1.0) : 0.0; };
  const double denominator = uu * vv - uv * uv;
  double t = denominator > 0 ? inside((uv * vw - uw * vv) / denominator) : 0;
  const double s = inside((uv * t + vw) / vv);
  t = inside((uv * s - uw) / uu);
  return {along(a, u, t), along(c, v, s)};
}

/// The projection of p onto a triangle, or the corner a if it falls outside the triangle.
Point on_triangle(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Vector u = b - a, v = c - a, w = p - a;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  const double denominator = uu * vv - uv * uv;
  const double t = (vv * uw - uv * vw) / denominator, s = (uu * vw - uv * uw) / denominator;
  if (!(denominator > 0) || !(t >= 0) || !(s >= 0) || !(t + s <= 1)) return a;  // then a side is nearest
  return along(along(a, u, t), v, s);
}

class Search {
 public:
  Search(std::span<const Point> vertices, std::span<const Triangle> first, std::span<const Triangle> second,
         const std::function<void()>& step)
      : vertices_(vertices), facets_{first, second}, step_(step) {
    for (std::size_t k = 0; k < 2; ++k) build(k);
  }

  NearestPoints run() {
    struct Pair {
      double bound;
      Index a, b;
      bool operator<(const Pair& other) const { return bound > other.bound; }
    };
    std::priority_queue<Pair> pairs;
    pairs.push({bound(nodes_[0][0].box, nodes_[1][0].box), 0, 0});
    std::size_t steps = 0;
    while (!pairs.empty() && pairs.top().bound < best_.distance) {
      const auto [least, a, b] = pairs.top();
      pairs.pop();
      if ((++steps & 0xFF) == 0) step_();
      const Node &m = nodes_[0][a], &n = nodes_[1][b];
      if (m.left == 0 && n.left == 0) {
        compare(m, n);
      } else if (n.left == 0 || (m.left != 0 && m.count >= n.count)) {
        for (const Index child : {m.left, m.left + 1})
          pairs.push({bound(nodes_[0][child].box, n.box), child, b});
      } else {
        for (const Index child : {n.left, n.left + 1})
          pairs.push({bound(m.box, nodes_[1][child].box), a, child});
      }
    }
    return best_;
  }

 private:
  struct Node {
    Box box;
    Index first, count, left;
  };
  static constexpr Index kLeaf = 4;

  [[nodiscard]] Box box_of(const Triangle& t) const {
    Box box{vertices_[t[0]], vertices_[t[0]]};
    for (const Index v : t) box.extend({vertices_[v], vertices_[v]});
    return box;
  }

  void build(std::size_t k) {
    order_[k].resize(facets_[k].size());
    std::iota(order_[k].begin(), order_[k].end(), Index{0});
    nodes_[k].push_back({{}, 0, static_cast<Index>(order_[k].size()), 0});
    for (Index n = 0; n < nodes_[k].size(); ++n) split(k, n);
  }

  void split(std::size_t k, Index n) {
    const Index first = nodes_[k][n].first, count = nodes_[k][n].count;
    Box box = box_of(facets_[k][order_[k][first]]);
    for (Index i = first; i < first + count; ++i) box.extend(box_of(facets_[k][order_[k][i]]));
    nodes_[k][n].box = box;
    if (count <= kLeaf) return;
    std::size_t axis = 0;
    for (std::size_t c = 1; c < 3; ++c)
      if (box.high[c] - box.low[c] > box.high[axis] - box.low[axis]) axis = c;
    const auto begin = order_[k].begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count, [&](Index f, Index g) {
      const double x = box_of(facets_[k][f]).centre(axis), y = box_of(facets_[k][g]).centre(axis);
      return x != y ? x < y : f < g;
    });
    nodes_[k][n].left = static_cast<Index>(nodes_[k].size());
    nodes_[k].push_back({{}, first, count / 2, 0});
    nodes_[k].push_back({{}, first + count / 2, count - count / 2, 0});
  }

  static double bound(const Box& a, const Box& b) {
    Vector gap{};
    for (std::size_t k = 0; k < 3; ++k) gap[k] = std::max({0.0, a.low[k] - b.high[k], b.low[k] - a.high[k]});
    return numbers::hypot(gap[0], gap[1], gap[2]);
  }

  void compare(const Node& m, const Node& n) {
    for (Index i = m.first; i < m.first + m.count; ++i)
      for (Index j = n.first; j < n.first + n.count; ++j)
        compare(facets_[0][order_[0][i]], facets_[1][order_[1][j]]);
  }

  void compare(const Triangle& f, const Triangle& g) {
    const auto at = [&](const Triangle& t, std::size_t i) -> const Point& { return vertices_[t[i % 3]]; };
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) take(between_sides(at(f, i), at(f, i + 1), at(g, j), at(g, j + 1)));
      take({at(f, i), on_triangle(at(f, i), at(g, 0), at(g, 1), at(g, 2))});
      take({on_triangle(at(g, i), at(f, 0), at(f, 1), at(f, 2)), at(g, i)});
    }
  }

  void take(const std::array<Point, 2>& points) {
    const double d = distance(points[0], points[1]);
    if (d < best_.distance) best_ = {d, points};
  }

  std::span<const Point> vertices_;
  std::array<std::span<const Triangle>, 2> facets_;
  const std::function<void()>& step_;
  std::array<std::vector<Index>, 2> order_;
  std::array<std::vector<Node>, 2> nodes_;
  NearestPoints best_{std::numeric_limits<double>::infinity(), {}};
};

}  // namespace

NearestPoints nearest_points(std::span<const Point> vertices, std::span<const Triangle> first,
                             std::span<const Triangle> second, const std::function<void()>& step) {
  return Search(vertices, first, second, step).run();
}

}  // namespace holdfast
