// Random valid complexes with facets, segments and points that dangle, in and on polyhedra.
//
// What is strewn is kept only where the exact diagnosis finds the complex valid.
#pragma once

#include <cmath>

#include "hard_surfaces.h"

namespace holdfast::hard {

inline Point between(const Point& a, const Point& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

// Adds what `more` adds where the complex stays valid.
template <typename More>
void try_adding(Surface& s, More more) {
  Surface next = s;
  more(next);
  if (diagnose(next.view(), 1).empty()) s = std::move(next);
}

class Furniture {
 public:
  Furniture(Surface& s, Random& random) : s_(s), random_(random), low_(s.vertices[0]), high_(low_) {
    for (const Point& p : s.vertices)
      for (std::size_t k = 0; k < 3; ++k) {
        low_[k] = std::min(low_[k], p[k]);
        high_[k] = std::max(high_[k], p[k]);
      }
  }

  void add(int pieces) {
    for (int k = 0; k < pieces; ++k) try_adding(s_, [&](Surface& s) { piece(s); });
  }

 private:
  Point point() {
    Point p{};
    for (std::size_t k = 0; k < 3; ++k) p[k] = uniform(random_, low_[k], high_[k]);
    return p;
  }

  Index any(std::size_t count) {
    return static_cast<Index>(integer(random_, 0, static_cast<int>(count) - 1));
  }

  Index vertex(Surface& s) {
    if (integer(random_, 0, 1) == 0) return any(s.vertices.size());
    s.vertices.push_back(point());
    return static_cast<Index>(s.vertices.size() - 1);
  }

  void piece(Surface& s) {
    const int kind = integer(random_, 0, 6);
    if (kind == 0) s.vertices.push_back(point());
    if (kind == 1) s.segments.push_back({vertex(s), vertex(s)});
    if (kind == 2) small::add_triangle(s, point(), point(), point());
    if (kind == 3) s.facets.push_back({vertex(s), vertex(s), vertex(s)});
    if (kind == 4) on_a_side(s, point());
    if (kind == 5) next_to_a_facet(s);
    if (kind == 6) beside_a_facet(s);
  }

  // A dangling triangle on a side of what there is: its segment gets a facet more.
  void on_a_side(Surface& s, const Point& apex) {
    const Triangle f = s.facets[any(s.facets.size())];
    s.vertices.push_back(apex);
    s.facets.push_back({f[0], f[1], static_cast<Index>(s.vertices.size() - 1)});
  }

  // At an angle to a facet that goes down to 1e-9.
  void next_to_a_facet(Surface& s) {
    const Triangle f = s.facets[any(s.facets.size())];
    Point apex = between(s.vertices[f[0]], s.vertices[f[1]], uniform(random_, 0.2, 0.8));
    apex = between(apex, s.vertices[f[2]], uniform(random_, 0.2, 0.8));
    on_a_side(s, between(apex, point(), log_uniform(random_, 1e-9, 1e-2)));
  }

  // In the plane of a facet, up to rounding, on the other side of its side.
  void beside_a_facet(Surface& s) {
    const Triangle f = s.facets[any(s.facets.size())];
    const Point middle = between(s.vertices[f[0]], s.vertices[f[1]], 0.5);
    s.vertices.push_back(between(s.vertices[f[2]], middle, uniform(random_, 1.1, 2)));
    s.facets.push_back({f[0], f[1], static_cast<Index>(s.vertices.size() - 1)});
  }

  Surface& s_;
  Random& random_;
  Point low_, high_;
};

inline Surface furnished(Random& random) {
  Surface s = integer(random, 0, 2) == 0   ? star(random)
              : integer(random, 0, 1) == 0 ? voxels(random)
                                           : small::box();
  Furniture(s, random).add(integer(random, 5, 40));
  return s;
}

// Triangles round one segment, in a box, some of them next to each other at tiny angles; some also with a
// long way between two of them, more than half a turn.
inline Surface pencil(Random& random) {
  Surface s = small::box({-2, -2, -2}, {2, 2, 3});
  small::add_segment(s, {0, 0, 0}, {0, 0, 1});
  const auto foot = static_cast<Index>(s.vertices.size() - 2);
  const int pages = integer(random, 1, 60);
  const double turn = integer(random, 0, 1) == 0 ? 2 * kPi : uniform(random, 0.1, 3);
  double angle = uniform(random, 0, 7);
  for (int k = 0; k < pages; ++k) {
    angle +=
        integer(random, 0, 4) == 0 ? log_uniform(random, 1e-9, 1e-3) : turn / pages * uniform(random, 0.5, 1);
    try_adding(s, [&](Surface& next) {
      next.vertices.push_back({std::cos(angle), std::sin(angle), uniform(random, 0, 1)});
      next.facets.push_back({foot, foot + 1, static_cast<Index>(next.vertices.size() - 1)});
    });
  }
  return s;
}

// A band of two triangles a step, closed with any number of half turns (Möbius for an odd one), or a spiral
// that is wound up tightly and stays open.
inline Surface band(Random& random) {
  Surface s = small::box({-3, -3, -3}, {3, 3, 3});
  const bool spiral = integer(random, 0, 1) == 0;
  const int half_turns = integer(random, 0, 3);
  const int steps = integer(random, 8, 30);
  const double width = uniform(random, 0.1, 0.6), lead = log_uniform(random, 0.01, 0.6);
  const auto first = static_cast<Index>(s.vertices.size());
  const auto n = static_cast<Index>(steps);
  for (int k = 0; k < steps; ++k) {
    const double t = 2 * kPi * k / steps;
    const double turns = spiral ? 3 * t : t;
    const double radius = spiral ? 1 + lead * turns / (2 * kPi) : 1.5;
    const double tilt = spiral ? kPi / 2 : half_turns * t / 2;
    for (const double side : {-width, width})
      s.vertices.push_back({(radius + side * std::cos(tilt)) * std::cos(turns),
                            (radius + side * std::cos(tilt)) * std::sin(turns), side * std::sin(tilt)});
  }
  for (Index k = 0; k + (spiral ? 1 : 0) < n; ++k) {
    const bool closing = k + 1 == n;
    Index a = first + 2 * k, b = a + 1, c = first + 2 * ((k + 1) % n), d = c + 1;
    if (closing && half_turns % 2 == 1) std::swap(c, d);
    try_adding(s, [&](Surface& next) {
      next.facets.push_back({a, b, c});
      next.facets.push_back({b, d, c});
    });
  }
  return s;
}

}  // namespace holdfast::hard
