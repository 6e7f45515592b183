// Small surfaces made by hand, for tests of several layers.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "holdfast/types.h"

namespace holdfast::small {

/// Of a box whose corners count along x, then y, then z; from outside.
inline constexpr std::array<Triangle, 12> kSidesOfBox{{{0, 2, 1},
                                                       {1, 2, 3},
                                                       {4, 5, 6},
                                                       {5, 7, 6},
                                                       {0, 1, 4},
                                                       {1, 5, 4},
                                                       {2, 6, 3},
                                                       {3, 6, 7},
                                                       {0, 4, 2},
                                                       {2, 4, 6},
                                                       {1, 3, 5},
                                                       {3, 7, 5}}};

inline Surface surface_of(std::vector<Point> vertices, std::vector<Triangle> facets,
                          std::vector<Segment> segments = {}) {
  Surface surface;
  surface.vertices = std::move(vertices);
  surface.facets = std::move(facets);
  surface.segments = std::move(segments);
  return surface;
}

/// Adds a box of 12 triangles that face outwards, or inwards. Corner 0 is `low`; bits of the corner's number
/// are x, y, z.
inline void add_box(Surface& surface, const Point& low, const Point& high, bool outwards = true) {
  const auto first = static_cast<Index>(surface.vertices.size());
  for (unsigned k = 0; k < 8; ++k)
    surface.vertices.push_back({(k & 1u) != 0 ? high[0] : low[0], (k & 2u) != 0 ? high[1] : low[1],
                                (k & 4u) != 0 ? high[2] : low[2]});
  constexpr std::array<std::array<Index, 4>, 6> kSides{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : kSides)
    for (Triangle t : {Triangle{a, b, c}, Triangle{a, c, d}}) {
      if (!outwards) std::swap(t[1], t[2]);
      surface.facets.push_back({first + t[0], first + t[1], first + t[2]});
    }
}

inline Surface box(const Point& low = {0, 0, 0}, const Point& high = {1, 1, 1}) {
  Surface surface;
  add_box(surface, low, high);
  return surface;
}

/// A box in a box, the inner one facing outwards too, or inwards as the surface of a cavity does.
inline Surface nested(bool inner_outwards) {
  Surface surface = box({0, 0, 0}, {3, 3, 3});
  add_box(surface, {1, 1, 1}, {2, 2, 2}, inner_outwards);
  return surface;
}

/// Two boxes that share a wall, 0 <= x <= 1 and 1 <= x <= 2; the last two triangles are the wall.
inline Surface touching() {
  Surface surface = box();
  for (const Point& p : {Point{2, 0, 0}, Point{2, 1, 0}, Point{2, 0, 1}, Point{2, 1, 1}})
    surface.vertices.push_back(p);
  const Triangle wall[2] = {surface.facets[10], surface.facets[11]};
  surface.facets.resize(10);
  constexpr std::array<Index, 8> kCorner{1, 8, 3, 9, 5, 10, 7, 11};  // of the second box
  const Surface second = box();
  for (std::size_t f = 0; f < 12; ++f) {
    if (f / 2 == 4) continue;  // its side x = 0 is the wall
    const Triangle& t = second.facets[f];
    surface.facets.push_back({kCorner[t[0]], kCorner[t[1]], kCorner[t[2]]});
  }
  surface.facets.insert(surface.facets.end(), {wall[0], wall[1]});
  return surface;
}

/// A box without its side z = 1.
inline Surface open_box() {
  Surface surface = box();
  surface.facets.erase(surface.facets.begin() + 2, surface.facets.begin() + 4);
  return surface;
}

/// Adds a triangle with three corners of its own.
inline void add_triangle(Surface& surface, const Point& a, const Point& b, const Point& c) {
  const auto first = static_cast<Index>(surface.vertices.size());
  surface.vertices.insert(surface.vertices.end(), {a, b, c});
  surface.facets.push_back({first, first + 1, first + 2});
}

inline void add_segment(Surface& surface, const Point& a, const Point& b) {
  const auto first = static_cast<Index>(surface.vertices.size());
  surface.vertices.insert(surface.vertices.end(), {a, b});
  surface.segments.push_back({first, first + 1});
}

/// The ends of a prism 0 1 2, 3 4 5, and its three sides, two triangles each with the diagonals 0 4, 1 5,
/// 2 3.
inline std::vector<Triangle> prism_facets(const Triangle& bottom, const Triangle& top) {
  std::vector<Triangle> facets{bottom, top};
  for (Index k = 0; k < 3; ++k) {
    const Index j = (k + 1) % 3;
    facets.insert(facets.end(), {{k, j, 3 + j}, {k, 3 + j, 3 + k}});
  }
  return facets;
}

/// The polyhedron of docs/concepts.md, What cannot be guaranteed, moved by `offset`: valid, of volume 1.5, it
/// needs a Steiner point (all of its diagonals lie outside) and holds no integer point.
inline Surface without_integer_points(double offset) {
  Surface surface;
  surface.vertices = {{2, 1, 0}, {1, 1, 3}, {1, 2, 1}, {3, 2, 2}, {0, 0, 3}, {2, 1, 3}};
  for (Point& p : surface.vertices)
    for (double& x : p) x += offset;
  surface.facets = prism_facets({0, 1, 2}, {3, 4, 5});
  return surface;
}

}  // namespace holdfast::small
