#include "surface/space.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>

#include "exact/predicates.h"
#include "mesh/disjoint_sets.h"
#include "surface/aabb_tree.h"

namespace holdfast {
namespace {

using exact::Dyadic;

enum Face : unsigned { front = 0, behind = 1 };
Face other(Face face) { return face == front ? behind : front; }

/// Whether the corners of a triangle follow each other as a, b.
bool has_in_order(const Triangle& t, Index a, Index b) {
  return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
}

Index apex_of(const Triangle& t, const Segment& side) {
  for (const Index v : t)
    if (v != side[0] && v != side[1]) return v;
  throw std::logic_error("holdfast: a facet has a corner twice");
}

/// Orders the facets round a side counterclockwise, seen from its end.
void sort_round(const Complex& complex, const Segment& side, std::vector<Index>& facets) {
  const auto turn = [&](Index f, Index g) {
    const auto at = [&](Index v) { return complex.vertices[v].data(); };
    return exact::orient3d(at(side[0]), at(side[1]), at(apex_of(complex.facets[f], side)),
                           at(apex_of(complex.facets[g], side)));
  };
  const Index first = facets[0];
  const auto half_of = [&](Index f) {  // of the turn from the first facet; it begins the first half
    if (f == first) return 0;
    const int sign = turn(first, f);
    return sign > 0 ? 1 : sign == 0 ? 2 : 3;
  };
  std::sort(facets.begin(), facets.end(), [&](Index f, Index g) {
    const int half_f = half_of(f), half_g = half_of(g);
    return half_f != half_g ? half_f < half_g : f != g && turn(f, g) > 0;
  });
}

/// A line parallel to an axis, from a point inside a facet towards larger coordinates.
class Line {
 public:
  /// The axis is one along which the facet has area. Different weights give different lines.
  Line(const Complex& complex, Index facet, std::array<unsigned, 3> weights) : complex_(complex) {
    const Triangle& t = complex.facets[facet];
    double most = -1;
    for (unsigned k = 0; k < 3; ++k) {
      const double size = std::fabs(area(t, k));
      if (!(size <= most) && turn_of(t, k) != 0) {
        axis_ = k;
        most = size;
      }
    }
    unsigned sum = 0;
    for (const unsigned w : weights) sum += w;  // a power of two
    for (unsigned k = 0; k < 3; ++k) {
      Dyadic& x = exact_.c[k];
      for (unsigned i = 0; i < 3; ++i) x += Dyadic(complex.vertices[t[i]][k]) * Dyadic(double(weights[i]));
      x = x.scaled(-std::countr_zero(sum));
      approx_[k] = x.to_double();
    }
  }

  [[nodiscard]] bool misses(const Box& box) const {
    const auto outside = [&](unsigned k) {
      constexpr double kFar = std::numeric_limits<double>::infinity();
      return std::nextafter(approx_[k], kFar) < box.low[k] || std::nextafter(approx_[k], -kFar) > box.high[k];
    };
    return outside((axis_ + 1) % 3) || outside((axis_ + 2) % 3) ||
           std::nextafter(approx_[axis_], -std::numeric_limits<double>::infinity()) > box.high[axis_];
  }

  /// A facet that the line passes, and its face that the line meets first.
  struct Hit {
    Index facet;
    Face near;
  };
  enum class Meets { no, inside, border };
  /// Whether the line to infinity in both directions meets a facet; `hit` is set if it meets the inside.
  [[nodiscard]] Meets meets(Index f, Hit& hit) const {
    const Triangle& t = complex_.facets[f];
    const int turn = turn_of(t, axis_);
    bool on_border = false;
    for (unsigned i = 0; i < 3; ++i) {
      const int sign = exact::orient2d(at(t[i]), at(t[(i + 1) % 3]), here(), static_cast<int>(axis_));
      if (sign != 0 && sign != turn && turn != 0) return Meets::no;
      if (sign != 0 && turn == 0) return Meets::no;
      on_border |= sign == 0;
    }
    if (on_border) return Meets::border;
    hit = {f, turn > 0 ? behind : front};
    return Meets::inside;
  }

  /// Whether the line passes the facet beyond its beginning.
  [[nodiscard]] bool is_ahead(const Hit& hit) const {
    const Triangle& t = complex_.facets[hit.facet];
    const int sign = exact::orient3d(at(t[0]), at(t[1]), at(t[2]), here());
    return sign != 0 && (sign > 0) == (hit.near == front);
  }

  /// Whether it passes f before g.
  [[nodiscard]] bool is_before(Index f, Index g) const {
    const Range of_f = range(f), of_g = range(g);
    if (of_f.high < of_g.low) return true;
    if (of_g.high < of_f.low) return false;
    const Place p = place(f), q = place(g);
    return p.numerator * q.denominator < q.numerator * p.denominator;
  }

  /// The face of the line's own facet that looks along the line.
  [[nodiscard]] Face begins_at(Index facet) const {
    return turn_of(complex_.facets[facet], axis_) > 0 ? front : behind;
  }

 private:
  [[nodiscard]] exact::PointRef at(Index v) const { return {complex_.vertices[v].data(), nullptr}; }
  [[nodiscard]] exact::PointRef here() const { return {approx_.data(), &exact_}; }
  [[nodiscard]] int turn_of(const Triangle& t, unsigned axis) const {
    return exact::orient2d(at(t[0]), at(t[1]), at(t[2]), static_cast<int>(axis));
  }
  [[nodiscard]] double area(const Triangle& t, unsigned axis) const {
    const unsigned u = (axis + 1) % 3, v = (axis + 2) % 3;
    const Point &a = complex_.vertices[t[0]], &b = complex_.vertices[t[1]], &c = complex_.vertices[t[2]];
    return (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
  }

  struct Range {
    double low, high;
  };
  [[nodiscard]] Range range(Index f) const {
    const Triangle& t = complex_.facets[f];
    const auto [low, high] = std::minmax(
        {complex_.vertices[t[0]][axis_], complex_.vertices[t[1]][axis_], complex_.vertices[t[2]][axis_]});
    return {low, high};
  }

  /// A coordinate along the axis, as a quotient.
  struct Place {
    Dyadic numerator, denominator;  // > 0
  };
  [[nodiscard]] Place place(Index f) const {
    const Triangle& t = complex_.facets[f];
    const unsigned u = (axis_ + 1) % 3, v = (axis_ + 2) % 3, w = axis_;
    const exact::ExactPoint a = exact::lift(complex_.vertices[t[0]].data());
    exact::ExactPoint b = exact::lift(complex_.vertices[t[1]].data());
    exact::ExactPoint c = exact::lift(complex_.vertices[t[2]].data());
    for (unsigned k = 0; k < 3; ++k) {
      b.c[k] -= a.c[k];
      c.c[k] -= a.c[k];
    }
    const auto normal = [&](unsigned i, unsigned j) { return b.c[i] * c.c[j] - b.c[j] * c.c[i]; };
    Place place{normal(v, w) * (a.c[u] - exact_.c[u]) + normal(w, u) * (a.c[v] - exact_.c[v]), normal(u, v)};
    place.numerator += place.denominator * a.c[w];
    if (place.denominator.sign() < 0) place = {-place.numerator, -place.denominator};
    return place;
  }

  const Complex& complex_;
  unsigned axis_ = 0;
  exact::ExactPoint exact_;
  std::array<double, 3> approx_{};
};

class Division {
 public:
  Division(const Complex& complex, const Step& step, const Threads& threads)
      : complex_(complex),
        step_(step),
        threads_(threads),
        faces_(2 * complex.facets.size() + 1),
        connected_(complex.facets.size()) {}

  DividedSpace run() {
    join_round_sides();
    join_along_lines();
    return numbered();
  }

 private:
  [[nodiscard]] static Index number(Index facet, Face face) { return 2 * facet + face; }
  [[nodiscard]] Index outside() const { return static_cast<Index>(2 * complex_.facets.size()); }

  void join_round_sides() {
    const SegmentTable table = segment_table(complex_, threads_);
    std::vector<Index> round;
    for (Index s = 0; s < table.segments.size(); ++s) {
      const auto facets = table.facets_of(s);
      if (facets.empty()) continue;
      const Segment& side = table.segments[s];
      round.assign(facets.begin(), facets.end());
      if (round.size() > 2) sort_round(complex_, side, round);
      const auto ahead = [&](Index f) {
        return has_in_order(complex_.facets[f], side[0], side[1]) ? front : behind;
      };
      for (std::size_t i = 0; i < round.size(); ++i) {
        const Index f = round[i], next = round[(i + 1) % round.size()];
        faces_.unite(number(f, ahead(f)), number(next, other(ahead(next))));
        connected_.unite(f, next);
      }
    }
  }

  void join_along_lines() {
    std::vector<Box> boxes;
    boxes.reserve(complex_.facets.size());
    for (const Triangle& t : complex_.facets) boxes.push_back(box_of(t));
    const AabbTree tree(boxes, {}, threads_);
    for (Index f = 0; f < complex_.facets.size(); ++f)
      if (connected_.root(f) == f) join_along_line(f, tree);
  }

  [[nodiscard]] Box box_of(const Triangle& t) const {
    Box box{complex_.vertices[t[0]], complex_.vertices[t[0]]};
    for (const Index v : t) box.extend({complex_.vertices[v], complex_.vertices[v]});
    return box;
  }

  /// Tries lines until one meets no vertex and no side.
  void join_along_line(Index facet, const AabbTree& tree) {
    constexpr unsigned kSum = 1u << 30;  // many more places than strips that may divide a facet
    for (;;) {
      const unsigned a = 1 + static_cast<unsigned>(random_() % (kSum - 2));
      const unsigned b = 1 + static_cast<unsigned>(random_() % (kSum - 1 - a));
      if (a + b >= kSum) continue;
      const Line line(complex_, facet, {a, b, kSum - a - b});
      const std::optional<std::vector<Line::Hit>> hits = hits_of(line, facet, tree);
      if (!hits) continue;
      Index last = number(facet, line.begins_at(facet));
      for (const Line::Hit& hit : *hits) {
        faces_.unite(last, number(hit.facet, hit.near));
        last = number(hit.facet, other(hit.near));
      }
      faces_.unite(last, outside());
      return;
    }
  }

  /// What a line meets, in order; nothing if it meets a border.
  [[nodiscard]] std::optional<std::vector<Line::Hit>> hits_of(const Line& line, Index own,
                                                              const AabbTree& tree) const {
    std::vector<Line::Hit> hits;
    bool meets_border = false;
    tree.for_each_item([&](const Box& box) { return meets_border || line.misses(box); },
                       [&](const AabbTree::Item& item) {
                         Line::Hit hit{};
                         const Line::Meets meets =
                             item.id == own ? Line::Meets::no : line.meets(item.id, hit);
                         if (meets == Line::Meets::border) meets_border = true;
                         if (meets == Line::Meets::inside && line.is_ahead(hit)) hits.push_back(hit);
                       });
    step_(0.5);
    if (meets_border) return std::nullopt;
    std::sort(hits.begin(), hits.end(), [&](const Line::Hit& x, const Line::Hit& y) {
      return x.facet != y.facet && line.is_before(x.facet, y.facet);
    });
    return hits;
  }

  [[nodiscard]] DividedSpace numbered() {
    DividedSpace space;
    std::vector<Index> region(2 * complex_.facets.size() + 1, no_index);
    region[faces_.root(outside())] = 0;
    for (Index f = 0; f < complex_.facets.size(); ++f) {
      std::array<Index, 2> sides{};
      for (const Face face : {front, behind}) {
        Index& at = region[faces_.root(number(f, face))];
        if (at == no_index) at = space.regions++;
        sides[face] = at;
      }
      space.of_facet.push_back(sides);
    }
    return space;
  }

  const Complex& complex_;
  const Step& step_;
  const Threads& threads_;
  DisjointSets faces_;      // two of each facet, and the outside
  DisjointSets connected_;  // facets, by sides
  std::mt19937_64 random_{1};
};

}  // namespace

DividedSpace divide_space(const Complex& complex, const Step& step, const Threads& threads) {
  return Division(complex, step, threads).run();
}

}  // namespace holdfast
