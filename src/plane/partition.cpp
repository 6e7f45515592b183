// Makes segments edges by adding points where they cross the mesh, then removes these points.
//
// clang-format off
//            S              A missing segment AB with the points P on it, whose triangles make two polygons,
//      S-   / \    S+       above and below. S is the vertex above that is furthest from AB, the first one at
//       \  / | \   /        that distance. So S- is nearer than S, and S+ is not further: S-, S, S+ and the
//        \/  |  \ /         outer two of the points joined to S bound a convex region. Therefore the edges
//   A----P---P---P----B     from S to the points can be swapped one after another, until S is joined only to
//                           S- and S+.
// clang-format on
#include "plane/partition.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace holdfast::plane {

Pieces Partition::insert(Vertex a, Vertex b, const std::vector<EdgeCode>& crossed) {
  Pieces pieces{a};
  std::vector<EdgeCode> edges = crossed;
  const exact::RationalPoint ra = points_.rational(a), rb = points_.rational(b);
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const Vertex p = points_.add(exact::crossing(ra, rb, points_.rational(mesh_.from(edges[k])),
                                                 points_.rational(mesh_.to(edges[k]))));
    // The far side of the next edge keeps its code, and gives the near side after the change.
    const EdgeCode far = k + 1 < edges.size() ? mesh_.across(edges[k + 1]) : kNoEdge;
    split(edges[k], p);
    if (far != kNoEdge) edges[k + 1] = mesh_.across(far);
    mesh_.constrain(mesh_.find_edge(p, pieces.back()));
    pieces.push_back(p);
  }
  mesh_.constrain(mesh_.find_edge(pieces.back(), b));
  pieces.push_back(b);
  return pieces;
}

std::uint32_t Partition::unused_triangle() {
  if (unused_.empty()) {
    mesh_.all().emplace_back();
    return static_cast<std::uint32_t>(mesh_.size() - 1);
  }
  const std::uint32_t t = unused_.back();
  unused_.pop_back();
  return t;
}

/// Puts p on edge e = (u, w) between the triangles (x, u, w) and (y, w, u), which become four.
void Partition::split(EdgeCode e, Vertex p) {
  const EdgeCode f = mesh_.across(e);
  const std::uint32_t xu = triangle_of(e), wx = unused_triangle(), yw = triangle_of(f),
                      uy = unused_triangle();
  const Vertex x = mesh_.apex(e), u = mesh_.from(e), w = mesh_.to(e), y = mesh_.apex(f);
  const std::array<EdgeCode, 4> sides{previous_edge(e), next_edge(e), previous_edge(f), next_edge(f)};
  std::array<std::pair<EdgeCode, std::uint32_t>, 4> outside;
  for (std::size_t k = 0; k < 4; ++k)
    outside[k] = {mesh_.across(sides[k]), mesh_.constrained(sides[k]) ? 1u : 0u};
  mesh_[xu].v = {p, x, u};
  mesh_[wx].v = {p, w, x};
  mesh_[yw].v = {p, y, w};
  mesh_[uy].v = {p, u, y};
  const std::array<std::uint32_t, 4> made{xu, wx, yw, uy};
  for (std::size_t k = 0; k < 4; ++k) {
    mesh_[made[k]].constrained = outside[k].second;
    mesh_.join(code(made[k], 0), outside[k].first);
  }
  mesh_.join(code(xu, 2), code(wx, 1));
  mesh_.join(code(wx, 2), code(yw, 1));
  mesh_.join(code(yw, 2), code(uy, 1));
  mesh_.join(code(uy, 2), code(xu, 1));
  mesh_.add_star(xu);
  for (const auto& [v, t] : {std::pair(x, xu), std::pair(u, xu), std::pair(w, wx), std::pair(y, yw)})
    if (v != kNoVertex) mesh_.set_star(v, t);
}

/// The vertices opposite the pieces on their left, from the first end to the last.
std::vector<Vertex> Partition::vertices_above(const Pieces& pieces) const {
  EdgeCode e = mesh_.find_edge(pieces[0], pieces[1]);
  std::vector<Vertex> above{mesh_.apex(e)};
  for (std::size_t i = 1; i + 1 < pieces.size(); ++i)
    for (;;) {
      const EdgeCode turned = mesh_.across(next_edge(e));
      const Vertex x = mesh_.apex(turned);
      e = turned;
      if (x == pieces[i + 1]) {
        e = next_edge(turned);
        break;
      }
      above.push_back(x);
    }
  return above;
}

/// Swaps until only one vertex above is joined to the points; returns that vertex.
Vertex Partition::disconnect_above(const Pieces& pieces) {
  const std::vector<Vertex> above = vertices_above(pieces);
  const Vertex a = pieces.front(), b = pieces.back();
  const auto n = static_cast<std::uint32_t>(above.size());
  std::vector<std::uint32_t> order(n), before(n + std::size_t{2}), behind(n + std::size_t{2});
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    return points_.compare_heights(a, b, above[j], above[i]) > 0;
  });
  // Places 1 to n are the vertices above; 0 and n + 1 are the ends of the segment.
  const auto vertex = [&](std::uint32_t place) {
    return place == 0 ? a : place == n + 1 ? b : above[place - 1];
  };
  for (std::uint32_t i = 0; i < n + 2; ++i) {
    before[i] = i == 0 ? 0 : i - 1;
    behind[i] = i + 1;
  }
  for (std::size_t k = 0; k + 1 < order.size(); ++k) {
    const std::uint32_t place = order[k] + 1, left = before[place], right = behind[place];
    if (left != 0)
      disconnect_to_the_left(vertex(place), vertex(left), vertex(right));
    else
      disconnect_to_the_right(vertex(place), vertex(left), vertex(right));
    behind[left] = right;
    before[right] = left;
  }
  return above[order.back()];
}

/// Swaps the edges from s to the points onto the vertex before it, from left to right.
void Partition::disconnect_to_the_left(Vertex s, Vertex before, Vertex behind) {
  EdgeCode e = mesh_.find_edge(s, before);  // with the leftmost point as its apex
  for (;;) {
    const EdgeCode swapped = previous_edge(e);
    const EdgeCode other = mesh_.across(swapped);
    const Vertex next = mesh_.apex(other);
    mesh_.flip(swapped);
    ++swaps_;
    if (next == behind) return;
    e = code(triangle_of(other), 0);
  }
}

/// If the vertex before s is the end of the segment, it is collinear with the points: the edges are swapped
/// onto the vertex after s, from right to left.
void Partition::disconnect_to_the_right(Vertex s, Vertex before, Vertex behind) {
  EdgeCode e = mesh_.find_edge(behind, s);  // with the rightmost point as its apex
  for (;;) {
    const EdgeCode swapped = next_edge(e);
    const Vertex next = mesh_.apex(mesh_.across(swapped));
    mesh_.flip(swapped);
    ++swaps_;
    if (next == before) return;
    e = code(triangle_of(swapped), 2);
  }
}

/// Replaces the fan of triangles between the pieces, given as edges seen from above, and one vertex by one
/// triangle. Its edge 2 is the segment.
std::uint32_t Partition::close(const std::vector<EdgeCode>& pieces) {
  const std::uint32_t t = triangle_of(pieces.front());
  const EdgeCode front = previous_edge(pieces.front()), back = next_edge(pieces.back());
  const std::array<Vertex, 3> v{mesh_.from(pieces.front()), mesh_.to(pieces.back()),
                                mesh_.apex(pieces.front())};
  const std::uint32_t constrained =
      (mesh_.constrained(back) ? 1u : 0u) | (mesh_.constrained(front) ? 2u : 0u) | 4u;
  const EdgeCode behind_back = mesh_.across(back), behind_front = mesh_.across(front);
  mesh_[t].v = v;
  mesh_[t].constrained = constrained;
  mesh_.join(code(t, 0), behind_back);
  mesh_.join(code(t, 1), behind_front);
  // The other triangles are not read until they are used again.
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    unused_.push_back(triangle_of(pieces[i]));
    mesh_[unused_.back()] = {{kNoVertex, kNoVertex, kNoVertex}, {kNoEdge, kNoEdge, kNoEdge}};
  }
  return t;
}

/// The edges of the pieces, seen from above.
std::vector<EdgeCode> Partition::edges_of(const Pieces& pieces) const {
  std::vector<EdgeCode> edges;
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i)
    edges.push_back(mesh_.find_edge(pieces[i], pieces[i + 1]));
  return edges;
}

std::size_t Partition::remove(const Pieces& pieces) {
  if (pieces.size() == 2) return 0;
  swaps_ = 0;
  const Pieces backwards(pieces.rbegin(), pieces.rend());
  const Vertex above = disconnect_above(pieces), below = disconnect_above(backwards);
  const std::vector<EdgeCode> edges_above = edges_of(pieces), edges_below = edges_of(backwards);
  const std::uint32_t t = close(edges_above), u = close(edges_below);
  mesh_.join(code(t, 2), code(u, 2));
  for (const Vertex v : {pieces.front(), pieces.back(), above}) mesh_.set_star(v, t);
  mesh_.set_star(below, u);
  return swaps_;
}

}  // namespace holdfast::plane
