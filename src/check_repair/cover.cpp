#include "check_repair/cover.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "check/findings.h"
#include "check_repair/closed_chains.h"
#include "check_repair/edge_sums.h"
#include "check_repair/near_triangle.h"
#include "check_repair/slits.h"
#include "text/decimal.h"

namespace holdfast::checking {
namespace {

double rough_area(const Point& a, const Point& b, const Point& c) {
  const Point u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  const Point n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  return rough_distance(n, Point{}) / 2;
}

}  // namespace

/// The cover of one triangle.
class Cover {
 public:
  Cover(CoverTest& test, const std::array<Point, 3>& triangle, const std::array<Index, 3>& places,
        std::span<const Index> chain)
      : test_(test),
        triangle_(triangle),
        places_(places),
        chain_(chain),
        near_(test.vertices_, triangle, *test.reach_) {
    for (const Index f : chain) flip(odd_, test_.facets_[f]);
  }

  /// Adds triangles where thin parts became lines. (d)
  void close_gaps() { Slits(odd_, at_gaps_, near_).close_gaps(); }
  void close_slits() { Slits(odd_, at_gaps_, near_).close(); }

  std::optional<std::string> gap() {
    for (std::size_t side = 0; side < 3; ++side)
      if (!take_side(side))
        return "no edges of the output lead along its side from vertex " + std::to_string(places_[side]) +
               " to vertex " + std::to_string(places_[(side + 1) % 3]) + told_cover();
    if (is_rest_on_sides() || fill_rest()) return std::nullopt;
    return words("its children end at edge", *first_astray_, test_.vertices_) + ", away from its sides" +
           told_cover();
  }

 private:
  unsigned sides_of(const Segment& edge) {
    if (const auto at_gap = at_gaps_.find(edge); at_gap != at_gaps_.end()) return at_gap->second;
    const unsigned sides = near_.sides_of(edge[0]) & near_.sides_of(edge[1]);
    const auto at_corner = at_corners_.find(edge);
    return at_corner == at_corners_.end() ? sides : sides | at_corner->second;
  }

  /// Joins the corners to all vertices within reach of them by edges. (c)
  void join_corners() {
    if (are_corners_joined_) return;
    are_corners_joined_ = true;
    for (std::size_t i = 0; i < 3; ++i)
      test_.near(Box(triangle_[i]), [&](Index f) {
        for (const Index v : test_.facets_[f])
          if (v != places_[i] && test_.reach_->of_point(test_.vertices_[v], triangle_[i]))
            at_corners_[edge_of(places_[i], v)] |= 1U << i | 1U << (i + 2) % 3;
      });
  }

  /// Removes a chain (b) for a side from the odd edges.
  bool take_side(std::size_t side) {
    const Index a = places_[side], b = places_[(side + 1) % 3];
    if (a == b) return true;
    std::set<Segment> usable;
    for (const Segment& edge : odd_)
      if ((sides_of(edge) >> side & 1U) != 0) usable.insert(edge);
    std::vector<Segment> found = path(neighbours_of(usable), usable, a, b);
    std::set<Segment> wider = usable;
    if (found.empty()) {
      Box box(triangle_[side]);
      box.extend(triangle_[(side + 1) % 3]);
      for_each_edge_near(box, [&](const Segment& edge) {
        if ((sides_of(edge) >> side & 1U) != 0) wider.insert(edge);
      });
      found = path(neighbours_of(wider), usable, a, b);
    }
    if (found.empty()) {
      join_corners();
      for (const auto& [edge, sides] : at_corners_)
        if ((sides >> side & 1U) != 0) wider.insert(edge);
      found = path(neighbours_of(wider), usable, a, b);
    }
    for (const Segment& edge : found) flip(odd_, edge);
    return !found.empty();
  }

  template <class Visit>
  void for_each_edge_near(const Box& box, Visit&& visit) {
    test_.near(box, [&](Index f) {
      const Triangle& t = test_.facets_[f];
      for (std::size_t i = 0; i < 3; ++i) visit(edge_of(t[i], t[(i + 1) % 3]));
    });
  }

  /// The remaining odd edges must fall into parts, each of which is a sum of closed chains of sides.
  bool is_rest_on_sides() {
    const Neighbours neighbours = neighbours_of(odd_);
    std::set<Index> seen;
    astray_.clear();
    for (const auto& [start, unused] : neighbours) {
      if (!seen.insert(start).second) continue;
      std::vector<Index> part{start};
      unsigned sides = ~0U;
      for (std::size_t i = 0; i < part.size(); ++i) {
        sides &= near_.sides_of(part[i]);
        for (const Index w : neighbours.at(part[i]))
          if (seen.insert(w).second) part.push_back(w);
      }
      if (sides != 0) continue;
      std::set<Segment> edges;
      for (const Index v : part)
        for (const Index w : neighbours.at(v)) edges.insert(edge_of(v, w));
      if (!is_of_closed_chains(edges)) astray_.merge(edges);
    }
    if (!astray_.empty()) {
      const auto away =
          std::find_if(astray_.begin(), astray_.end(), [&](const Segment& e) { return sides_of(e) == 0; });
      first_astray_ = away != astray_.end() ? *away : *astray_.begin();
    }
    return astray_.empty();
  }

  /// For several sides: where they meet, edges of the output that lie on two sides may be in both chains.
  bool is_of_closed_chains(const std::set<Segment>& odd) {
    join_corners();
    if (std::any_of(odd.begin(), odd.end(), [&](const Segment& e) { return sides_of(e) == 0; })) return false;
    std::vector<SidedEdge> edges;
    std::set<Segment> told;
    const auto tell = [&](const Segment& edge, bool is_odd) {
      const unsigned sides = sides_of(edge);
      if ((is_odd || std::popcount(sides) > 1) && told.insert(edge).second)
        edges.push_back({edge, sides, is_odd});
    };
    Box box(test_.vertices_[(*odd.begin())[0]]);
    for (const Segment& edge : odd) {
      tell(edge, true);
      for (const Index v : edge) box.extend(test_.vertices_[v]);
    }
    for (const auto& [edge, unused] : at_corners_) tell(edge, false);
    for_each_edge_near(box, [&](const Segment& edge) { tell(edge, false); });
    return are_closed_chains(edges);
  }

  using AtEdge = std::map<Segment, std::vector<Index>>;

  /// Removes children from the chain, or adds thin facets near the triangle, as long as fewer edges are
  /// astray afterwards. All thin facets come first: removing a large child opens a side that nothing else
  /// closes.
  bool fill_rest() {
    AtEdge thin, all;
    Box box(triangle_[0]);
    box.extend(triangle_[1]);
    box.extend(triangle_[2]);
    const std::set<Index> children(chain_.begin(), chain_.end());
    test_.near(box, [&](Index f) {
      const Triangle& t = test_.facets_[f];
      const bool is_thin = is_thin_and_near(t);
      for (std::size_t i = 0; i < 3; ++i) {
        const Segment edge = edge_of(t[i], t[(i + 1) % 3]);
        if (is_thin) thin[edge].push_back(f);
        if (is_thin || children.contains(f)) all[edge].push_back(f);
      }
    });
    for (const AtEdge* facets : {&thin, &all}) {
      flip_at_astray(*facets);
      if (is_rest_on_sides()) return true;
    }
    return false;
  }

  /// Adds or removes facets with two or three odd sides, starting from the edges that are astray.
  void flip_at_astray(const AtEdge& at_edge) {
    std::vector<Segment> open(astray_.begin(), astray_.end());
    while (!open.empty()) {
      const Segment edge = open.back();
      open.pop_back();
      const auto at = at_edge.find(edge);
      if (at == at_edge.end() || !odd_.contains(edge)) continue;
      for (const Index f : at->second) {
        const Triangle& t = test_.facets_[f];
        std::size_t odd = 0;
        for (std::size_t i = 0; i < 3; ++i) odd += odd_.count(edge_of(t[i], t[(i + 1) % 3]));
        if (odd < 2) continue;
        flip(odd_, t);
        for (std::size_t i = 0; i < 3; ++i) open.push_back(edge_of(t[i], t[(i + 1) % 3]));
        break;
      }
    }
  }

  [[nodiscard]] bool is_thin_and_near(const Triangle& t) const {
    return inscribed_at_most({test_.vertices_[t[0]], test_.vertices_[t[1]], test_.vertices_[t[2]]},
                             test_.reach_->distance()) &&
           std::all_of(t.begin(), t.end(),
                       [&](Index v) { return test_.reach_->of_triangle(test_.vertices_[v], triangle_); });
  }

  [[nodiscard]] std::string told_cover() const {
    double sum = 0;
    for (const Index f : chain_) {
      const Triangle& t = test_.facets_[f];
      sum += rough_area(test_.vertices_[t[0]], test_.vertices_[t[1]], test_.vertices_[t[2]]);
    }
    return "; they have " + decimal(sum) + " of its area of " +
           decimal(rough_area(triangle_[0], triangle_[1], triangle_[2]));
  }

  CoverTest& test_;
  const std::array<Point, 3>& triangle_;
  const std::array<Index, 3>& places_;
  std::span<const Index> chain_;
  std::set<Segment> odd_;
  NearTriangle near_;
  std::map<Segment, unsigned> at_corners_;
  Slits::Ends at_gaps_;
  bool are_corners_joined_ = false;
  std::set<Segment> astray_;
  std::optional<Segment> first_astray_;
};

const BoxTree& CoverTest::tree() {
  if (!tree_) {
    std::vector<Box> boxes;
    boxes.reserve(facets_.size());
    for (const Triangle& t : facets_) boxes.push_back(box_of(t, vertices_));
    tree_.emplace(std::move(boxes));
  }
  return *tree_;
}

template <class Visit>
void CoverTest::near(Box box, Visit&& visit) {
  // Rounded outwards: the box contains everything within reach.
  for (std::size_t k = 0; k < 3; ++k) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    box.low[k] = std::nextafter(box.low[k] - reach_->distance(), -kInfinity);
    box.high[k] = std::nextafter(box.high[k] + reach_->distance(), kInfinity);
  }
  tree().query([&](const Box& other) { return other.meets(box); }, visit);
}

Index CoverTest::within_reach(const Point& p, Index vertex) {
  if (vertex != no_entity && reach_->of_point(vertices_[vertex], p)) return vertex;
  Index found = no_entity;
  near(Box(p), [&](Index f) {
    for (const Index v : facets_[f])
      if (v < found && reach_->of_point(vertices_[v], p)) found = v;
  });
  return found;
}

std::optional<std::string> CoverTest::gap(const std::array<Point, 3>& triangle, std::array<Index, 3> places,
                                          std::span<const Index> chain) {
  for (std::size_t i = 0; i < 3; ++i) {
    places[i] = within_reach(triangle[i], places[i]);
    if (places[i] == no_entity)
      return "no vertex of the output is within " + decimal(reach_->distance()) + " of its corner at " +
             words(triangle[i]);
  }
  std::array<Index, 3> corners = places;
  std::sort(corners.begin(), corners.end());
  for (const Index f : chain) {
    Triangle t = facets_[f];
    std::sort(t.begin(), t.end());
    if (t == corners) return std::nullopt;
  }
  std::optional<std::string> gap = Cover(*this, triangle, places, chain).gap();
  if (!gap) return gap;
  // What is closed as a gap may be a facet that is there, and a slit that ends at it stays open.
  for (const bool closes_gaps : {false, true}) {
    Cover closed(*this, triangle, places, chain);
    if (closes_gaps) closed.close_gaps();
    closed.close_slits();
    if (!closed.gap()) return std::nullopt;
  }
  return gap;
}

std::optional<std::string> CoverTest::gap(const std::array<Point, 2>& segment, std::array<Index, 2> places,
                                          std::span<const Segment> chain) {
  std::set<Index> odd;
  const auto flip_end = [&](Index v) {
    if (const auto [at, is_new] = odd.insert(v); !is_new) odd.erase(at);
  };
  for (std::size_t i = 0; i < 2; ++i) {
    if (places[i] == no_entity || !reach_->of_point(vertices_[places[i]], segment[i]))
      return "its end at " + words(segment[i]) + " is no vertex of the output within " +
             decimal(reach_->distance());
    flip_end(places[i]);
  }
  for (const auto& [a, b] : chain) {
    flip_end(a);
    flip_end(b);
  }
  if (odd.empty()) return std::nullopt;
  return "its children end at vertex " + std::to_string(*odd.begin()) + " " + words(vertices_[*odd.begin()]);
}

}  // namespace holdfast::checking
