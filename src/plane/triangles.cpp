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

}  // namespace holdfast::plane
