// Makes segments edges by swaps, and triangles constrained Delaunay by swaps.
#include "plane/swaps.h"

namespace holdfast::plane {

/// As long as an edge is crossed, some crossed edge can be swapped, and some sequence of swaps that never
/// increases their number removes them all. Random swaps find one with probability 1.
std::size_t SegmentSwaps::lay(Vertex a, Vertex b, const std::vector<EdgeCode>& crossed,
                              numbers::Random& random, std::vector<EdgeCode>& swapped, std::size_t most) {
  a_ = a;
  b_ = b;
  links_.clear();
  standing_.clear();
  const auto n = static_cast<std::uint32_t>(crossed.size());
  for (std::uint32_t k = 0; k < n; ++k) {
    links_.push_back({crossed[k], k > 0 ? k - 1 : kNone, k + 1 < n ? k + 1 : kNone, k});
    standing_.push_back(k);
  }
  std::size_t swaps = 0;
  while (!standing_.empty() && swaps < most) {
    const std::size_t k = standing_.size() == 1 ? 0 : numbers::below(standing_.size(), random);
    const EdgeCode diagonal = swap(k);
    if (diagonal == kNoEdge) continue;
    swapped.push_back(diagonal);
    swapped.push_back(mesh_.across(diagonal));
    ++swaps;
  }
  return swaps;
}

/// Tries to swap the k-th crossed edge. Returns the new edge, or kNoEdge if the swap is impossible.
EdgeCode SegmentSwaps::swap(std::size_t k) {
  const std::uint32_t link = standing_[k];
  const EdgeCode e = links_[link].edge;
  const Vertex p = mesh_.apex(e), from = mesh_.from(e), to = mesh_.to(e), q = mesh_.apex(mesh_.across(e));
  if (points_.orient(p, from, q) <= 0 || points_.orient(q, to, p) <= 0) return kNoEdge;
  const std::uint32_t before = links_[link].before, after = links_[link].after;
  // The far side of the next edge keeps its code, and gives the near side after the flip.
  const EdgeCode far = after == kNone ? kNoEdge : mesh_.across(links_[after].edge);
  mesh_.flip(e);
  if (after != kNone) links_[after].edge = mesh_.across(far);
  const std::uint32_t t = triangle_of(e);
  const EdgeCode diagonal = code(t, 1);
  if (crosses(p, q)) {
    links_[link].edge = near_side(diagonal, before);
  } else {
    remove(link);
  }
  return diagonal;
}

/// The diagonal, seen from the triangle that the segment enters first: the one after the previous edge, or at
/// a.
EdgeCode SegmentSwaps::near_side(EdgeCode diagonal, std::uint32_t before) const {
  const std::uint32_t t = triangle_of(diagonal);
  const bool here = before != kNone ? triangle_of(mesh_.across(links_[before].edge)) == t
                                    : mesh_[t].v[0] == a_ || mesh_[t].v[1] == a_ || mesh_[t].v[2] == a_;
  return here ? diagonal : mesh_.across(diagonal);
}

void SegmentSwaps::remove(std::uint32_t link) {
  const auto [edge, before, after, place] = links_[link];
  if (before != kNone) links_[before].after = after;
  if (after != kNone) links_[after].before = before;
  standing_[place] = standing_.back();
  links_[standing_[place]].place = place;
  standing_.pop_back();
}

namespace {

bool legal(const Triangles& mesh, const Points& points, EdgeCode e) {
  const EdgeCode f = mesh.across(e);
  if (f == kNoEdge || mesh.constrained(e)) return true;
  const std::array<Vertex, 3>& v = mesh[triangle_of(e)].v;
  const Vertex opposite = mesh.apex(f);
  if (opposite == kNoVertex || v[0] == kNoVertex || v[1] == kNoVertex || v[2] == kNoVertex) return true;
  return points.incircle(v[0], v[1], v[2], opposite) <= 0;
}

}  // namespace

std::size_t swap_to_delaunay(Triangles& mesh, const Points& points, std::vector<EdgeCode>& pending,
                             const Poll& poll) {
  std::size_t swaps = 0, looks = 0;
  while (!pending.empty()) {
    const EdgeCode e = pending.back();
    pending.pop_back();
    if (++looks % 4096 == 0 && poll) poll(1 - 1 / (1 + 1e-6 * static_cast<double>(looks)));
    if (legal(mesh, points, e)) continue;
    const std::uint32_t t = triangle_of(e), u = triangle_of(mesh.across(e));
    mesh.flip(e);
    ++swaps;
    for (const EdgeCode side : {code(t, 0), code(t, 2), code(u, 0), code(u, 2)}) pending.push_back(side);
  }
  return swaps;
}

std::size_t swap_to_delaunay(Triangles& mesh, const Points& points, const Poll& poll) {
  std::vector<EdgeCode> pending;
  for (std::size_t t = 0; t < mesh.size(); ++t)
    for (std::uint32_t i = 0; i < 3; ++i)
      if (mesh[t].across[i] != kNoEdge && code(t, i) < mesh[t].across[i]) pending.push_back(code(t, i));
  return swap_to_delaunay(mesh, points, pending, poll);
}

}  // namespace holdfast::plane
