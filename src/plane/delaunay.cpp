// Delaunay triangulation of points in the plane.
#include "plane/delaunay.h"

#include <algorithm>
#include <utility>

namespace holdfast::plane {

void Inserter::begin(Vertex a, Vertex b, Vertex c) {
  if (points_.orient(a, b, c) < 0) std::swap(b, c);
  LargeVector<Corners>& all = mesh_.all();
  all.clear();
  all.push_back({{a, b, c}, {}});
  all.push_back({{kNoVertex, c, b}, {}});
  all.push_back({{kNoVertex, a, c}, {}});
  all.push_back({{kNoVertex, b, a}, {}});
  for (std::uint32_t i = 0; i < 3; ++i) mesh_.join(code(0, i), code(i + 1, 0));
  // Ghost i + 1 is (infinity, end, begin of edge i); its edge 1 is shared with the ghost of the previous
  // edge.
  mesh_.join(code(1, 1), code(3, 2));
  mesh_.join(code(2, 1), code(1, 2));
  mesh_.join(code(3, 1), code(2, 2));
  last_ = 0;
}

/// The visibility walk, which terminates in Delaunay triangulations (Edelsbrunner 1990). Returns a triangle
/// that contains p, or a ghost whose hull edge has p strictly in front.
std::uint32_t Inserter::locate(Vertex p) {
  std::uint32_t t = last_;
  EdgeCode came_from = kNoEdge;
  for (;;) {
    const Corners& c = mesh_[t];
    std::uint32_t ghost = 3;
    for (std::uint32_t i = 0; i < 3; ++i)
      if (c.v[i] == kNoVertex) ghost = i;
    if (ghost < 3) {
      if (came_from != kNoEdge) return t;
      t = triangle_of(c.across[ghost]);
      continue;
    }
    EdgeCode leave = kNoEdge;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const EdgeCode e = code(t, i);
      if (e == came_from) continue;
      if (points_.orient(c.v[(i + 1) % 3], c.v[(i + 2) % 3], p) < 0) {
        leave = e;
        break;
      }
    }
    if (leave == kNoEdge) return t;
    came_from = mesh_.across(leave);
    t = triangle_of(came_from);
  }
}

bool Inserter::in_conflict(std::uint32_t t, Vertex p) const {
  const std::array<Vertex, 3>& v = mesh_[t].v;
  for (std::uint32_t i = 0; i < 3; ++i) {
    if (v[i] != kNoVertex) continue;
    const Vertex a = v[(i + 1) % 3], b = v[(i + 2) % 3];
    const int side = points_.orient(a, b, p);
    return side > 0 || (side == 0 && points_.between(a, b, p));
  }
  return points_.incircle(v[0], v[1], v[2], p) > 0;
}

/// Depth first, with each triangle's sides counterclockwise; this yields the border in order.
void Inserter::find_cavity(std::uint32_t first, Vertex p) {
  cavity_.assign(1, first);
  border_.clear();
  mesh_[first].mark = 1;
  pending_.assign({code(first, 2), code(first, 1), code(first, 0)});
  while (!pending_.empty()) {
    const EdgeCode e = pending_.back();
    pending_.pop_back();
    const EdgeCode other = mesh_.across(e);
    const std::uint32_t t = triangle_of(other);
    if (mesh_[t].mark != 0) continue;
    if (in_conflict(t, p)) {
      mesh_[t].mark = 1;
      cavity_.push_back(t);
      pending_.push_back(previous_edge(other));
      pending_.push_back(next_edge(other));
    } else {
      border_.push_back({mesh_.from(e), mesh_.to(e), other});
    }
  }
}

/// Joins p to every side of the border, which adds two triangles.
void Inserter::fill_cavity(Vertex p) {
  LargeVector<Corners>& all = mesh_.all();
  while (cavity_.size() < border_.size()) {
    cavity_.push_back(static_cast<std::uint32_t>(all.size()));
    all.emplace_back();
  }
  const std::size_t n = border_.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Side& side = border_[k];
    const std::uint32_t t = cavity_[k];
    all[t] = {
        {p, side.from, side.to},
        {side.outside, code(cavity_[k + 1 < n ? k + 1 : 0], 2), code(cavity_[k > 0 ? k - 1 : n - 1], 1)}};
    all[triangle_of(side.outside)].across[edge_of(side.outside)] = code(t, 0);
    if (side.from != kNoVertex && side.to != kNoVertex) last_ = t;
  }
}

bool Inserter::insert(Vertex p) {
  const std::uint32_t t = locate(p);
  for (const Vertex v : mesh_[t].v)
    if (v != kNoVertex && points_.compare(v, p) == 0) return false;
  find_cavity(t, p);
  fill_cavity(p);
  return true;
}

std::optional<Triangles> delaunay(const Points& points, const Poll& poll) {
  const std::size_t n = points.size();
  Triangles mesh;
  // The first triangle takes the first point, the next one, and the first point that is not collinear with
  // them.
  Vertex third = 2;
  while (third < n && points.orient(0, 1, third) == 0) ++third;
  if (n > 1 && points.compare(0, 1) == 0) return std::nullopt;
  if (third >= n) return mesh;
  mesh.all().reserve(2 * n);
  Inserter inserter(mesh, points);
  inserter.begin(0, 1, third);
  for (std::size_t i = 2; i < n; ++i) {
    if (i % 4096 == 0 && poll) poll(static_cast<double>(i) / static_cast<double>(n));
    if (i != third && !inserter.insert(static_cast<Vertex>(i))) return std::nullopt;
  }
  return mesh;
}

}  // namespace holdfast::plane
