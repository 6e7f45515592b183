// Points put into constrained Delaunay triangles, by splits and swaps (Lawson 1977).
#include "plane/insertion.h"

#include <utility>

namespace holdfast::plane {

Insertion::Place Insertion::locate(Vertex p, Vertex start, std::uint32_t t) const {
  constexpr int kMostSteps = 1 << 20;  // an exact walk past vertices on the line may cycle
  EdgeCode came_from = kNoEdge;
  for (int step = 0; step < kMostSteps; ++step) {
    EdgeCode leave = kNoEdge, on = kNoEdge;
    int zeros = 0;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const EdgeCode e = code(t, i);
      const Vertex a = mesh_.from(e), b = mesh_.to(e);
      const int side = points_.orient(a, b, p);
      if (side == 0) {
        on = e;
        ++zeros;
      }
      if (side >= 0 || e == came_from) continue;
      if (points_.orient(start, p, a) <= 0 && points_.orient(start, p, b) >= 0) leave = e;
    }
    if (leave == kNoEdge) {
      const bool outside = [&] {
        for (std::uint32_t i = 0; i < 3; ++i)
          if (points_.orient(mesh_.from(code(t, i)), mesh_.to(code(t, i)), p) < 0) return true;
        return false;
      }();
      if (outside || zeros > 1) return {};
      if (zeros == 1) return {Place::Kind::on_edge, t, on};
      return {Place::Kind::inside, t, kNoEdge};
    }
    if (mesh_.constrained(leave)) return {Place::Kind::behind_constraint, t, leave};
    came_from = mesh_.across(leave);
    if (came_from == kNoEdge) return {};
    t = triangle_of(came_from);
  }
  return {};
}

std::uint32_t Insertion::add(std::array<Vertex, 3> corners, std::uint32_t mark) {
  const auto t = static_cast<std::uint32_t>(mesh_.size());
  mesh_.all().push_back({{}, {kNoEdge, kNoEdge, kNoEdge}, 0, mark});
  set(t, corners);
  return t;
}

void Insertion::set(std::uint32_t t, std::array<Vertex, 3> corners) {
  mesh_[t].v = corners;
  mesh_[t].constrained = 0;
  for (const Vertex v : corners) mesh_.set_star(v, t);
}

/// Restores the neighbour and the constraint flag of an edge.
void Insertion::take(EdgeCode e, std::pair<EdgeCode, bool> outside) {
  mesh_.join(e, outside.first);
  if (outside.second) mesh_[triangle_of(e)].constrained |= 1u << edge_of(e);
}

//            c
//          / | \          The new triangles have p as corner 2, so that edge 2 is the outer one.
//        /   p   \        .
//      a --------- b
void Insertion::insert_inside(std::uint32_t t, Vertex p) {
  const auto [a, b, c] = mesh_[t].v;
  const auto ab = outside(code(t, 2)), bc = outside(code(t, 0)), ca = outside(code(t, 1));
  set(t, {a, b, p});
  const std::uint32_t u = add({b, c, p}, mesh_[t].mark), w = add({c, a, p}, mesh_[t].mark);
  take(code(t, 2), ab);
  take(code(u, 2), bc);
  take(code(w, 2), ca);
  mesh_.join(code(t, 0), code(u, 1));
  mesh_.join(code(u, 0), code(w, 1));
  mesh_.join(code(w, 0), code(t, 1));
  pending_ = {code(t, 2), code(u, 2), code(w, 2)};
  swap_round();
}

//          b                     Edge e = (a, b) of t, with x on its left and, except on a border, y on its
//        / | \                   right. The pieces are constraints if the edge is one.
//      x t p u y                 .
//        \ | /
//          a
bool Insertion::insert_on(EdgeCode e, Vertex p) {
  const EdgeCode f = mesh_.across(e);
  const Vertex a = mesh_.from(e), b = mesh_.to(e), x = mesh_.apex(e);
  if (points_.orient(x, a, p) <= 0 || points_.orient(x, p, b) <= 0) return false;
  const Vertex y = f == kNoEdge ? kNoVertex : mesh_.apex(f);
  if (f != kNoEdge && (points_.orient(y, b, p) <= 0 || points_.orient(y, p, a) <= 0)) return false;
  const bool constrained = mesh_.constrained(e);
  const std::uint32_t t = triangle_of(e);
  const auto bx = outside(next_edge(e)), xa = outside(previous_edge(e));
  std::pair<EdgeCode, bool> ay, yb;
  if (f != kNoEdge) {
    ay = outside(next_edge(f));
    yb = outside(previous_edge(f));
  }
  set(t, {x, a, p});
  const std::uint32_t n = add({x, p, b}, mesh_[t].mark);
  take(code(t, 2), xa);
  take(code(n, 1), bx);
  mesh_.join(code(t, 1), code(n, 2));
  mesh_[t].across[0] = mesh_[n].across[0] = kNoEdge;
  pending_ = {code(t, 2), code(n, 1)};
  if (f != kNoEdge) {
    const std::uint32_t u = triangle_of(f);
    set(u, {y, b, p});
    const std::uint32_t m = add({y, p, a}, mesh_[u].mark);
    take(code(u, 2), yb);
    take(code(m, 1), ay);
    mesh_.join(code(u, 1), code(m, 2));
    mesh_.join(code(t, 0), code(m, 0));
    mesh_.join(code(n, 0), code(u, 0));
    pending_.push_back(code(u, 2));
    pending_.push_back(code(m, 1));
  }
  if (constrained) {
    mesh_.constrain(code(t, 0));
    mesh_.constrain(code(n, 0));
  }
  swap_round();
  return true;
}

void Insertion::swap_round() {
  while (!pending_.empty()) {
    const EdgeCode e = pending_.back();
    pending_.pop_back();
    const EdgeCode f = mesh_.across(e);
    if (f == kNoEdge || mesh_.constrained(e)) continue;
    const auto& [a, b, c] = mesh_[triangle_of(e)].v;
    if (points_.incircle(a, b, c, mesh_.apex(f)) <= 0) continue;
    mesh_.flip(e);
    // The new point was opposite e: it is corner 0 of the one triangle and corner 2 of the other.
    pending_.push_back(code(triangle_of(e), 0));
    pending_.push_back(code(triangle_of(f), 2));
  }
}

}  // namespace holdfast::plane
