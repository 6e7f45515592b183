// Surfaces whose vertices were split, as programs do at seams of textures and normals, and the same surfaces
// with each place once, by a few lines that share nothing with the library.
#pragma once

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <vector>

#include "holdfast/types.h"

namespace holdfast::split {

using Random = std::mt19937_64;

inline bool one_in(Random& random, unsigned n) { return random() % n == 0; }

/// What a surface should be taken as.
struct Joined {
  Surface surface;
  std::vector<std::int64_t> map;     ///< by vertex of the other surface
  std::vector<std::int64_t> origin;  ///< by vertex of this one: the first of the other
};

inline bool finite(const Point& p) { return std::isfinite(p[0] + p[1] + p[2]); }

inline Joined joined(const Surface& surface) {
  std::vector<bool> used(surface.vertices.size(), false);
  for (const Triangle& f : surface.facets)
    for (const Index v : f) used[v] = true;
  for (const Segment& s : surface.segments)
    for (const Index v : s) used[v] = true;
  std::map<Point, bool> taken;  // places of used vertices
  for (Index v = 0; v < used.size(); ++v)
    if (used[v]) taken[surface.vertices[v]] = true;

  Joined result;
  result.surface = surface;
  result.surface.vertices.clear();
  std::map<Point, std::int64_t> at;
  for (Index v = 0; v < used.size(); ++v) {
    const Point& p = surface.vertices[v];
    result.map.push_back(-1);
    if (!used[v] && (!finite(p) || taken.contains(p))) continue;
    const auto [place, fresh] = at.try_emplace(p, static_cast<std::int64_t>(result.origin.size()));
    if (fresh) {
      result.origin.push_back(v);
      result.surface.vertices.push_back(p);
    }
    if (fresh || used[v]) result.map[v] = place->second;
  }
  for (Triangle& f : result.surface.facets)
    for (Index& v : f) v = static_cast<Index>(result.map[v]);
  for (Segment& s : result.surface.segments)
    for (Index& v : s) v = static_cast<Index>(result.map[v]);
  return result;
}

/// Corners of facets and ends of segments get vertices of their own at random; so do zeros their sign. Among
/// the vertices, shuffled, are unused ones: copies, and some that are not finite.
inline Surface split_at_random(const Surface& whole, Random& random) {
  Surface surface = whole;
  const unsigned rarely = 1 + static_cast<unsigned>(random() % 4);
  const auto copy_of = [&](Index v) {
    Point p = whole.vertices[v];
    for (double& x : p)
      if (x == 0 && one_in(random, 2)) x = -x;
    surface.vertices.push_back(p);
    return static_cast<Index>(surface.vertices.size() - 1);
  };
  for (Triangle& f : surface.facets)
    for (Index& v : f)
      if (one_in(random, rarely)) v = copy_of(v);
  for (Segment& s : surface.segments)
    for (Index& v : s)
      if (one_in(random, rarely)) v = copy_of(v);
  for (unsigned k = 0; k < random() % 4; ++k)
    static_cast<void>(copy_of(static_cast<Index>(random() % whole.vertices.size())));
  for (unsigned k = 0; k < random() % 3; ++k)
    surface.vertices.push_back({0, std::numeric_limits<double>::quiet_NaN(), 1});

  std::vector<Index> order(surface.vertices.size());
  for (Index v = 0; v < order.size(); ++v) order[v] = v;
  for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[random() % k]);
  const std::vector<Point> before = surface.vertices;
  for (Index v = 0; v < order.size(); ++v) surface.vertices[order[v]] = before[v];
  for (Triangle& f : surface.facets)
    for (Index& v : f) v = order[v];
  for (Segment& s : surface.segments)
    for (Index& v : s) v = order[v];
  return surface;
}

/// Every facet has three vertices of its own, every segment two.
inline Surface soup(const Surface& whole) {
  Surface surface = whole;
  surface.vertices.clear();
  const auto add = [&](Index v) {
    surface.vertices.push_back(whole.vertices[v]);
    return static_cast<Index>(surface.vertices.size() - 1);
  };
  for (Triangle& f : surface.facets)
    for (Index& v : f) v = add(v);
  for (Segment& s : surface.segments)
    for (Index& v : s) v = add(v);
  return surface;
}

}  // namespace holdfast::split
