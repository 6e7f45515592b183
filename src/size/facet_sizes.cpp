#include "size/facet_sizes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "numbers/vector.h"
#include "size/tuning.h"

namespace holdfast {
namespace {

constexpr std::uint32_t kLeaf = 4;
constexpr std::uint32_t kFacetsALook = 1 << 14;  // this many are parted in some milliseconds
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::pair<Point, Point> kNothing{{kInfinity, kInfinity, kInfinity},
                                           {-kInfinity, -kInfinity, -kInfinity}};

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

// Distance to a triangle: to its plane over its inside, else to the nearest side.
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

struct Centre {
  Point place;
  std::uint32_t facet;
};

Point centre_of(const std::array<Point, 3>& t) {
  Point centre;
  for (std::size_t k = 0; k < 3; ++k) centre[k] = t[0][k] / 3 + t[1][k] / 3 + t[2][k] / 3;
  return centre;
}

void extend(Point& low, Point& high, const Point& other_low, const Point& other_high) {
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = std::min(low[k], other_low[k]);
    high[k] = std::max(high[k], other_high[k]);
  }
}

// Parts by the place along an axis. No two places compare equal, so the halves do not depend on the standard
// library.
void part_in_middle(std::span<Centre> centres) {
  auto [low, high] = kNothing;
  for (const Centre& c : centres) extend(low, high, c.place, c.place);
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  const auto middle = centres.begin() + static_cast<std::ptrdiff_t>(centres.size() / 2);
  std::nth_element(centres.begin(), middle, centres.end(), [axis](const Centre& f, const Centre& g) {
    return f.place[axis] != g.place[axis] ? f.place[axis] < g.place[axis] : f.facet < g.facet;
  });
}

}  // namespace

FacetSizes::FacetSizes(std::span<const Facet> facets, Wanted wanted, const Threads& threads,
                       double part_of_most_need)
    : wanted_(wanted) {
  for (Index k = 0; k < facets.size(); ++k) {
    const Facet& f = facets[k];
    const bool is_asked = f.is_asked || wanted == Wanted::anywhere;
    const double need = (is_asked ? tuning::kNeedWhereAsked : tuning::kNeedOfFacet) * longest_side(f.corners);
    if (!(need > tuning::kFarBeyond * f.wanted || wanted == Wanted::anywhere)) continue;
    const bool is_limit = f.is_asked && wanted == Wanted::at_corners;
    const double most = is_limit ? tuning::kMostNeedWhereAsked * part_of_most_need : tuning::kMostNeed;
    facets_.push_back({f.corners, std::min(need, most * f.wanted), k, f.is_asked,
                       is_limit ? tuning::kClearanceWhereAsked : tuning::kLeastClearance});
  }
  threads.poll();
  if (facets_.empty()) return;
  part_facets(threads);
  // Children come after their parents.
  for (std::size_t node = nodes_.size(); node-- > 0;) enclose(nodes_[node]);
}

// Parts each node at the median of its facets along the longest extent of their centres, and leaves the
// facets in the order of the leaves.
void FacetSizes::part_facets(const Threads& threads) {
  std::vector<Centre> centres(facets_.size());
  for (std::uint32_t f = 0; f < centres.size(); ++f) centres[f] = {centre_of(facets_[f].corners), f};
  threads.poll();
  nodes_.push_back({{}, {}, 0, 0, static_cast<std::uint32_t>(facets_.size()), 0});
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
    const std::uint32_t first = nodes_[node].first, count = nodes_[node].count, half = count / 2;
    if (count <= kLeaf) continue;
    part_in_middle(std::span(centres).subspan(first, count));
    nodes_[node].left = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({{}, {}, 0, first, half, 0});
    nodes_.push_back({{}, {}, 0, first + half, count - half, 0});
    if (count > kFacetsALook) threads.poll();
  }
  std::vector<Held> parted;
  parted.reserve(facets_.size());
  for (const Centre& c : centres) parted.push_back(facets_[c.facet]);
  facets_ = std::move(parted);
  threads.poll();
}

void FacetSizes::enclose(Node& node) const {
  if (node.left == 0) {
    std::tie(node.low, node.high) = kNothing;
    for (std::uint32_t f = node.first; f < node.first + node.count; ++f) {
      node.need = std::max(node.need, facets_[f].need);
      for (const Point& p : facets_[f].corners) extend(node.low, node.high, p, p);
    }
    return;
  }
  const Node &x = nodes_[node.left], &y = nodes_[node.left + 1];
  node.low = x.low;
  node.high = x.high;
  extend(node.low, node.high, y.low, y.high);
  node.need = std::max(x.need, y.need);
}

template <typename Act>
void FacetSizes::for_each_near(const Point& x, double rate, const double& size, By by, Act&& act) const {
  if (nodes_.empty()) return;
  std::array<std::uint32_t, 64> stack{};
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& n = nodes_[stack[--depth]];
    if (!(n.need > size) || square(n.need - size) <= square(rate) * distance2_to_box(x, n.low, n.high))
      continue;
    if (n.left != 0) {
      // First the one that may need more: it raises the size, so that less of the other one matters.
      const auto rank = [&](const Node& child) {
        return child.need - rate * std::sqrt(distance2_to_box(x, child.low, child.high));
      };
      const bool left_first = rank(nodes_[n.left]) > rank(nodes_[n.left + 1]);
      stack[depth++] = left_first ? n.left + 1 : n.left;
      stack[depth++] = left_first ? n.left : n.left + 1;
      continue;
    }
    for (std::uint32_t k = n.first; k < n.first + n.count; ++k) {
      const Held& f = facets_[k];
      if (f.need > size && !(f.is_asked && by == By::surface) && !act(f, distance_to(x, f.corners))) return;
    }
  }
}

double FacetSizes::most_need(double size) const {
  return wanted_ == Wanted::anywhere ? tuning::kMostNeed * size : std::numeric_limits<double>::infinity();
}

template <typename Note>
double FacetSizes::raised(const Point& x, double size, By by, Note&& note) const {
  const double most = most_need(size), least = wanted_ == Wanted::anywhere ? tuning::kFarBeyond * size : 0;
  for_each_near(x, tuning::kFallOfNeed, size, by, [&](const Held& f, double distance) {
    const double need = std::min(f.need, most) - tuning::kFallOfNeed * distance;
    if (f.need > least && need > size) {
      size = need;
      note(f);
    }
    return true;
  });
  return size;
}

double FacetSizes::bearable(const Point& x, double size, By by) const {
  return raised(x, size, by, [](const Held&) {});
}

FacetSizes::Limit FacetSizes::limit(const Point& x, double size, By by) const {
  Index facet = no_entity;
  const double most = raised(x, size, by, [&](const Held& f) { facet = f.facet; });
  return {most, facet};
}

bool FacetSizes::is_too_near(const Point& x, double size, By by) const {
  constexpr double most_clearance = std::max(tuning::kLeastClearance, tuning::kClearanceWhereAsked);
  const double most = most_need(size), least = wanted_ == Wanted::anywhere ? tuning::kFarBeyond * size : 0;
  bool is_near = false;
  for_each_near(x, tuning::kFallOfNeed + 1 / most_clearance, 0, by, [&](const Held& f, double distance) {
    const double need = f.need > least ? std::min(f.need, most) : 0;
    is_near = distance < f.clearance * (need - tuning::kFallOfNeed * distance);
    return !is_near;
  });
  return is_near;
}

}  // namespace holdfast
