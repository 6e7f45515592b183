// A plane triangulation that grows by points and segments.
#include "arrange/flat_mesh.h"

#include <array>
#include <stdexcept>
#include <utility>

#include "numbers/random.h"
#include "plane/swaps.h"

namespace holdfast::arrange {

using plane::code;
using plane::edge_of;
using plane::kNoEdge;
using plane::kNoVertex;
using plane::next_edge;
using plane::previous_edge;
using plane::triangle_of;

FlatMesh::FlatMesh(plane::Points& points, Vertex a, Vertex b, Vertex c) : points_(points) {
  mesh_.all().push_back({{a, b, c}, {kNoEdge, kNoEdge, kNoEdge}});
  mesh_.find_stars(points.size());
  sides_.resize(points.size(), 0);
  sides_[a] = 0b110;
  sides_[b] = 0b101;
  sides_[c] = 0b011;
}

std::uint32_t FlatMesh::add_triangle() {
  mesh_.all().push_back({{kNoVertex, kNoVertex, kNoVertex}, {kNoEdge, kNoEdge, kNoEdge}});
  return static_cast<std::uint32_t>(mesh_.size() - 1);
}

void FlatMesh::put(std::uint32_t t, std::array<Vertex, 3> v) {
  mesh_[t].v = v;
  mesh_[t].constrained = 0;
  for (const Vertex corner : v) mesh_.set_star(corner, t);
}

/// Walks towards p (Devillers, Pion, Teillaud 2002: with random choices of edges the walk ends in any mesh).
/// Returns the code of the triangle that holds p: with edge 0 if p is inside, else with the edge that p is
/// on.
EdgeCode FlatMesh::locate(Vertex p, unsigned& zeros) const {
  std::uint32_t t = last_, turn = 1;
  for (;;) {
    zeros = 0;
    EdgeCode on = code(t, 0), out = kNoEdge;
    turn = numbers::next_congruential(turn);
    const std::uint32_t first = (turn >> 24) % 3;
    for (std::uint32_t k = 0; k < 3 && out == kNoEdge; ++k) {
      const EdgeCode e = code(t, (first + k) % 3);
      const int side = orient(mesh_.from(e), mesh_.to(e), p);
      if (side < 0) out = e;
      if (side == 0) {
        ++zeros;
        on = e;
      }
    }
    if (out == kNoEdge) {
      last_ = t;
      return on;
    }
    const EdgeCode beyond = mesh_.across(out);
    if (beyond == kNoEdge) throw std::logic_error("a point of a sheet lies outside it");
    t = triangle_of(beyond);
  }
}

void FlatMesh::insert(Vertex p, unsigned sides) {
  mesh_.add_star(0);
  if (sides != 0) {
    sides_.resize(p, 0);
    sides_.push_back(static_cast<std::uint8_t>(sides));
  }
  unsigned zeros = 0;
  const EdgeCode at = locate(p, zeros);
  if (zeros > 1) throw std::logic_error("two points of a sheet are at one place");
  if (zeros == 1)
    split_edge(at, p);
  else
    split_triangle(triangle_of(at), p);
  legalise();
}

void FlatMesh::split_triangle(std::uint32_t t, Vertex p) {
  const auto [v, across, constrained, mark] = mesh_[t];
  const std::array<std::uint32_t, 3> part{t, add_triangle(), add_triangle()};
  for (std::uint32_t i = 0; i < 3; ++i) {
    put(part[i], {p, v[(i + 1) % 3], v[(i + 2) % 3]});
    mesh_[part[i]].constrained = constrained >> i & 1;
    mesh_.join(code(part[i], 0), across[i]);
    pending_.push_back(code(part[i], 0));
  }
  for (std::uint32_t i = 0; i < 3; ++i) mesh_.join(code(part[i], 1), code(part[(i + 1) % 3], 2));
}

/// Edge e = (u, w) has x on its left and y on its right; beyond a border there is no y.
void FlatMesh::split_edge(EdgeCode e, Vertex p) {
  const EdgeCode f = mesh_.across(e);
  const Vertex u = mesh_.from(e), w = mesh_.to(e), x = mesh_.apex(e);
  const bool constrained = mesh_.constrained(e);
  struct Outside {
    EdgeCode across;
    bool constrained;
  };
  const auto outside = [&](EdgeCode side) { return Outside{mesh_.across(side), mesh_.constrained(side)}; };
  const auto make = [&](std::uint32_t t, Vertex second, Vertex third, Outside side) {
    put(t, {p, second, third});
    mesh_[t].constrained = side.constrained ? 1 : 0;
    mesh_.join(code(t, 0), side.across);
    pending_.push_back(code(t, 0));
  };
  const Outside wx = outside(next_edge(e)), xu = outside(previous_edge(e));
  const std::uint32_t t0 = triangle_of(e), t1 = add_triangle();
  if (f == kNoEdge) {
    make(t0, w, x, wx);
    make(t1, x, u, xu);
    mesh_[t0].across[2] = mesh_[t1].across[1] = kNoEdge;
  } else {
    const Vertex y = mesh_.apex(f);
    const Outside uy = outside(next_edge(f)), yw = outside(previous_edge(f));
    const std::uint32_t t2 = triangle_of(f), t3 = add_triangle();
    make(t0, w, x, wx);
    make(t1, x, u, xu);
    make(t2, u, y, uy);
    make(t3, y, w, yw);
    mesh_.join(code(t2, 1), code(t3, 2));
    mesh_.join(code(t0, 2), code(t3, 1));
    mesh_.join(code(t1, 1), code(t2, 2));
  }
  mesh_.join(code(t0, 1), code(t1, 2));
  if (!constrained) return;
  mesh_.constrain(code(t0, 2));
  mesh_.constrain(code(t1, 1));
  // The whole edge never comes back, so its entry may stay.
  if (const std::uint32_t line = line_of_.find(key(u, w)); line != no_entity) {
    line_of_.find_or_add(key(u, p), line);
    line_of_.find_or_add(key(p, w), line);
  }
}

/// Lawson's flips, where the vertex is certainly inside the circle: each one is an improvement, so they end.
void FlatMesh::legalise() {
  while (!pending_.empty()) {
    const EdgeCode e = pending_.back();
    pending_.pop_back();
    const EdgeCode f = mesh_.across(e);
    if (f == kNoEdge || mesh_.constrained(e)) continue;
    const std::array<Vertex, 3>& v = mesh_[triangle_of(e)].v;
    if (!points_.surely_in_circle(v[0], v[1], v[2], mesh_.apex(f))) continue;
    const std::uint32_t t = triangle_of(e), u = triangle_of(f);
    mesh_.flip(e);
    for (const EdgeCode side : {code(t, 0), code(t, 2), code(u, 0), code(u, 2)}) pending_.push_back(side);
  }
}

/// Calls visit(corner code) for the triangles at v until it returns false; edge i of the code is opposite v.
template <class Visit>
void FlatMesh::for_each_corner(Vertex v, Visit&& visit) const {
  const EdgeCode start = mesh_.edge_from(v);  // from v: its previous corner is v
  EdgeCode e = start;
  do {
    if (!visit(next_edge(e))) return;  // opposite to v
    const EdgeCode other = mesh_.across(e);
    if (other == kNoEdge) break;
    e = next_edge(other);
  } while (e != start);
  if (e == start && mesh_.across(e) != kNoEdge) return;
  // The walk reached a border: the remaining triangles are in the other direction.
  e = start;
  for (;;) {
    const EdgeCode other = mesh_.across(previous_edge(e));  // the edge into v
    if (other == kNoEdge) return;
    e = other;
    if (e == start || !visit(next_edge(e))) return;
  }
}

EdgeCode FlatMesh::edge_between(Vertex a, Vertex b) const {
  EdgeCode found = kNoEdge;
  for_each_corner(a, [&](EdgeCode opposite) {
    if (mesh_.from(opposite) == b) found = previous_edge(opposite);
    if (found == kNoEdge && mesh_.to(opposite) == b) {
      // As seen from the edge's right, or from its left if there is a triangle.
      const EdgeCode in = next_edge(opposite);
      found = mesh_.across(in) != kNoEdge ? mesh_.across(in) : in;
    }
    return found == kNoEdge;
  });
  return found;
}

FlatMesh::Departure FlatMesh::depart(Vertex from, Vertex to, Vertex behind) const {
  Departure found;
  for_each_corner(from, [&](EdgeCode opposite) {
    const Vertex right = mesh_.from(opposite), left = mesh_.to(opposite);
    const auto side = [&](Vertex v) { return v == to || v == behind ? 0 : orient(from, to, v); };
    const auto is_on = [&](Vertex v) { return v == to || (v != behind && points_.between(from, to, v)); };
    const int on_right = side(right);
    if (on_right == 0 && is_on(right)) {
      found.along = right;
      return false;
    }
    const int on_left = side(left);
    if (on_left == 0 && is_on(left)) {
      found.along = left;
      return false;
    }
    if (on_right < 0 && on_left > 0) {
      found.across = opposite;
      return false;
    }
    return true;
  });
  if (found.along == kNoVertex && found.across == kNoEdge) throw std::logic_error("a trace leaves its sheet");
  return found;
}

void FlatMesh::constrain(Vertex from, Vertex to, std::uint32_t line) {
  mesh_.constrain(edge_between(from, to));
  line_of_.find_or_add(key(from, to), line);
}

void FlatMesh::lay(Vertex from, Vertex to, const std::vector<EdgeCode>& crossed, std::uint32_t line) {
  if (!crossed.empty()) {
    if (!random_) random_.emplace(1);
    plane::SegmentSwaps(mesh_, points_).lay(from, to, crossed, *random_, pending_);
  }
  constrain(from, to, line);
  legalise();
}

void FlatMesh::insert_segment(Vertex a, Vertex b, std::uint32_t line, const Crossing& crossing) {
  for (Vertex at = a, behind = kNoVertex; at != b;) {
    const Departure leaving = depart(at, b, behind);
    Vertex next = leaving.along;
    if (next != kNoVertex) {
      constrain(at, next, line);
    } else {
      Passage passage = pass(at, b, leaving.across);
      if (passage.segment != kNoEdge) {
        const Vertex p = cut_segment(passage.segment, line, crossing);
        // The triangles at the segment have changed, but the way to p crosses no other one.
        const Departure again = depart(at, p, behind);
        passage = again.along == p ? Passage{p} : pass(at, p, again.across);
      }
      next = passage.next;
      lay(at, next, passage.crossed, line);
    }
    behind = std::exchange(at, next);
  }
}

/// Follows the line from one vertex to another across edges, from `leave` on: to the next vertex on the line,
/// or to a segment that crosses it.
FlatMesh::Passage FlatMesh::pass(Vertex from, Vertex to, EdgeCode leave) const {
  Passage passage;
  while (!mesh_.constrained(leave)) {
    passage.crossed.push_back(leave);
    const EdgeCode entered = mesh_.across(leave);
    if (entered == kNoEdge) throw std::logic_error("a trace leaves its sheet");
    const Vertex corner = mesh_.apex(entered);
    const int side = corner == to ? 0 : orient(from, to, corner);
    if (side == 0) {
      passage.next = corner;
      return passage;
    }
    leave = side > 0 ? next_edge(entered) : previous_edge(entered);
  }
  passage.segment = leave;
  return passage;
}

/// Puts the vertex where the line crosses a segment. Returns the vertex.
Vertex FlatMesh::cut_segment(EdgeCode segment, std::uint32_t line, const Crossing& crossing) {
  const Vertex p = crossing(line, line_of_.find(key(mesh_.from(segment), mesh_.to(segment))));
  mesh_.add_star(0);
  split_edge(segment, p);
  return p;
}

std::vector<Vertex> FlatMesh::chain(Vertex a, Vertex b) const {
  std::vector<Vertex> vertices{a};
  for (Vertex behind = kNoVertex; vertices.back() != b; behind = vertices[vertices.size() - 2]) {
    const Vertex next = depart(vertices.back(), b, behind).along;
    if (next == kNoVertex) throw std::logic_error("a side of a facet is no chain of edges");
    vertices.push_back(next);
  }
  return vertices;
}

}  // namespace holdfast::arrange
