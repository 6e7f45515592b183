// A mesh of triangles in the plane.
#include "plane/triangles.h"

#include <algorithm>
#include <utility>

namespace holdfast::plane {

void Triangles::constrain(EdgeCode e) {
  all_[triangle_of(e)].constrained |= 1u << edge_of(e);
  if (const EdgeCode other = across(e); other != kNoEdge)
    all_[triangle_of(other)].constrained |= 1u << edge_of(other);
}

void Triangles::flip(EdgeCode e) {
  const EdgeCode f = across(e);
  const std::uint32_t t = triangle_of(e), u = triangle_of(f);
  const Vertex p = apex(e), a = from(e), b = to(e), q = apex(f);
  const EdgeCode bp = next_edge(e), pa = previous_edge(e), aq = next_edge(f), qb = previous_edge(f);
  const auto outside = [&](EdgeCode side) { return std::pair(across(side), constrained(side) ? 1u : 0u); };
  const auto [bp_across, bp_bit] = outside(bp);
  const auto [pa_across, pa_bit] = outside(pa);
  const auto [aq_across, aq_bit] = outside(aq);
  const auto [qb_across, qb_bit] = outside(qb);
  all_[t].v = {p, a, q};
  all_[u].v = {q, b, p};
  all_[t].constrained = aq_bit | pa_bit << 2;
  all_[u].constrained = bp_bit | qb_bit << 2;
  join(code(t, 0), aq_across);
  join(code(t, 2), pa_across);
  join(code(u, 0), bp_across);
  join(code(u, 2), qb_across);
  join(code(t, 1), code(u, 1));
  if (!star_.empty()) {
    touch(t);
    touch(u);
  }
}

void Triangles::find_stars(std::size_t vertices) {
  star_.assign(vertices, kNoVertex);
  for (std::size_t t = 0; t < all_.size(); ++t) touch(static_cast<std::uint32_t>(t));
}

EdgeCode Triangles::edge_from(Vertex v) const {
  const std::uint32_t t = star_[v];
  if (t == kNoVertex) return kNoEdge;
  const std::array<Vertex, 3>& c = all_[t].v;
  const std::uint32_t i = c[0] == v ? 0 : c[1] == v ? 1 : 2;
  return previous_edge(code(t, i));
}

EdgeCode Triangles::find_edge(Vertex a, Vertex b) const {
  const EdgeCode first = edge_from(a);
  if (first == kNoEdge) return kNoEdge;
  EdgeCode e = first;
  do {
    if (to(e) == b) return e;
    e = turn_right(e);
  } while (e != first);
  return kNoEdge;
}

Triangles Triangles::joined(const std::vector<std::array<Vertex, 3>>& corners,
                            const std::vector<std::array<Vertex, 2>>& segments) {
  Triangles mesh;
  mesh.all_.reserve(corners.size());
  Vertex most = 0;
  for (const std::array<Vertex, 3>& c : corners) {
    mesh.all_.push_back({c, {kNoEdge, kNoEdge, kNoEdge}});
    most = std::max({most, c[0], c[1], c[2]});
  }
  // Edges in lists by their lower ends, each by the higher one.
  struct Edge {
    Vertex high;
    EdgeCode edge;
  };
  std::vector<std::uint32_t> first(std::size_t{most} + 2, 0);
  const auto each_edge = [&](auto&& visit) {
    for (std::size_t t = 0; t < corners.size(); ++t)
      for (std::uint32_t i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax(corners[t][(i + 1) % 3], corners[t][(i + 2) % 3]);
        visit(low, Edge{high, code(t, i)});
      }
  };
  each_edge([&](Vertex low, const Edge&) { ++first[low + 1]; });
  for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
  std::vector<Edge> edges(3 * corners.size());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  each_edge([&](Vertex low, const Edge& edge) { edges[next[low]++] = edge; });
  const auto before = [](const Edge& e, const Edge& f) { return e.high < f.high; };
  for (std::size_t v = 0; v + 1 < first.size(); ++v) {
    std::sort(edges.begin() + first[v], edges.begin() + first[v + 1], before);
    for (std::size_t i = first[v]; i + 1 < first[v + 1]; ++i)
      if (edges[i].high == edges[i + 1].high) mesh.join(edges[i].edge, edges[i + 1].edge);
  }
  for (const std::array<Vertex, 2>& s : segments) {
    const auto [low, high] = std::minmax(s[0], s[1]);
    if (low > most) continue;
    const auto end = edges.begin() + first[low + 1];
    const auto found = std::lower_bound(edges.begin() + first[low], end, Edge{high, kNoEdge}, before);
    if (found != end && found->high == high) mesh.constrain(found->edge);
  }
  return mesh;
}

}  // namespace holdfast::plane
