// Whether the triangles of a sheet still fit together after its points are rounded.
#include "arrange/fits_rounded.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "exact/predicates.h"

namespace holdfast::arrange {
namespace {

using plane::Position;
using plane::Vertex;

int turn(const Position& a, const Position& b, const Position& c) {
  return exact::orient2d(a.data(), b.data(), c.data());
}

Position middle(const Position& a, const Position& b) { return {a[0] / 2 + b[0] / 2, a[1] / 2 + b[1] / 2}; }

/// The points of the border, counterclockwise from point 0 back to itself.
std::vector<Vertex> border_of(const plane::Triangles& triangles) {
  std::unordered_map<Vertex, Vertex> next;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::uint32_t i = 0; i < 3; ++i)
      if (const plane::EdgeCode e = plane::code(t, i); triangles.across(e) == plane::kNoEdge)
        next[triangles.from(e)] = triangles.to(e);
  std::vector<Vertex> border{0};
  do border.push_back(next.at(border.back()));
  while (border.back() != 0);
  return border;
}

/// Whether the rounded border is certainly a simple polygon: each side is monotone, and at each corner of two
/// sides, the line from the corner to the middle of the third side separates them.
bool border_is_simple(const std::vector<Vertex>& border, const plane::Points& points) {
  const Vertex second = *std::find_if(border.begin() + 1, border.end(), [](Vertex v) { return v < 3; });
  const std::array<Vertex, 3> corner{0, second, 3 - second};
  std::size_t k = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Position &a = points[corner[i]], &b = points[corner[(i + 1) % 3]], &c = points[corner[(i + 2) % 3]];
    const Position opposite_a = middle(b, c), opposite_b = middle(c, a);
    const std::size_t axis = std::fabs(b[0] / 2 - a[0] / 2) < std::fabs(b[1] / 2 - a[1] / 2) ? 1 : 0;
    const bool ascends = a[axis] < b[axis];
    do {
      const Position &p = points[border[k]], &q = points[border[k + 1]];
      if (ascends ? !(p[axis] < q[axis]) : !(q[axis] < p[axis])) return false;
      if (turn(a, opposite_a, q) >= 0 || turn(b, opposite_b, p) <= 0) return false;
      ++k;
    } while (border[k] >= 3);
  }
  return true;
}

}  // namespace

bool fits_rounded(const plane::Triangles& triangles, const plane::Points& points) {
  for (Vertex v = 0; v < points.size(); ++v)
    if (!std::isfinite(points[v][0]) || !std::isfinite(points[v][1])) return false;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t].v;
    if (turn(points[a], points[b], points[c]) <= 0) return false;
  }
  return border_is_simple(border_of(triangles), points);
}

}  // namespace holdfast::arrange
