#include "refine/rim.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace holdfast {
namespace {

// The corners of a side.
constexpr std::array<std::array<std::size_t, 2>, 3> kSide{{{1, 2}, {2, 0}, {0, 1}}};

}  // namespace

void RimEdges::list(std::span<const RimFace> rim, const RimVertices& vertices) {
  if (fits_table(vertices)) {
    const std::size_t n = vertices.size();
    if (table_.size() < n * n) table_.resize(n * n);
    for (std::uint32_t k = 0; k < rim.size(); ++k)
      for (std::uint32_t i = 0; i < 3; ++i)
        table_[rim[k].local[kSide[i][0]] * n + rim[k].local[kSide[i][1]]] = face_code(k, static_cast<int>(i));
    return;
  }
  list_by_ends(rim, vertices.size());
}

void RimEdges::list_by_ends(std::span<const RimFace> rim, std::size_t vertex_count) {
  degree_.assign(vertex_count, 0);
  for (const RimFace& r : rim)
    for (const std::uint32_t u : r.local) ++degree_[u];
  first_.assign(vertex_count + 1, 0);
  for (const RimFace& r : rim)
    for (const auto& [i, j] : kSide) ++first_[end_of(r.local[i], r.local[j]) + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  next_ = first_;
  sides_.resize(3 * rim.size());
  for (std::size_t k = 0; k < rim.size(); ++k)
    for (std::size_t side = 0; side < 3; ++side) {
      const std::uint32_t u = rim[k].local[kSide[side][0]], w = rim[k].local[kSide[side][1]],
                          end = end_of(u, w);
      sides_[next_[end]++] = {end == u ? w : u, new_face(k, side)};
    }
}

bool RimEdges::has(std::span<const RimFace> rim, const RimVertices& vertices, Vertex a, Vertex b) const {
  if (!vertices.has(a) || !vertices.has(b)) return false;
  if (!fits_table(vertices)) {
    const std::uint32_t u = vertices.place(a), w = vertices.place(b), end = end_of(u, w);
    const std::uint32_t other = end == u ? w : u;
    return std::any_of(sides_.begin() + first_[end], sides_.begin() + first_[end + 1],
                       [&](const Side& side) { return side.other == other; });
  }
  const std::uint32_t entry = table_[vertices.place(a) * vertices.size() + vertices.place(b)];
  const std::size_t k = entry >> 2;
  if (k >= rim.size() || (entry & 3u) == 3u) return false;
  const auto& side = kSide[entry & 3u];
  return rim[k].v[side[0]] == a && rim[k].v[side[1]] == b;
}

void RimEdges::link(std::span<const RimFace> rim, const RimVertices& vertices, std::span<NewTet> new_tets) {
  if (fits_table(vertices))
    link_by_table(rim, vertices.size(), new_tets);
  else
    link_by_ends(new_tets);
}

// Face i of a new tetrahedron, i < 3, lies at side i of its face of the rim; the neighbour has the same edge
// reversed.
void RimEdges::link_by_table(std::span<const RimFace> rim, std::size_t side,
                             std::span<NewTet> new_tets) const {
  for (std::size_t k = 0; k < rim.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i)
      new_tets[k].neighbours[i] =
          table_[rim[k].local[kSide[i][1]] * side + rim[k].local[kSide[i][0]]] | kNewFace;
}

// Pairs the first side at an edge with the second.
void RimEdges::link_by_ends(std::span<NewTet> new_tets) {
  for (std::size_t end = 0; end + 1 < first_.size(); ++end)
    for (std::size_t x = first_[end]; x < first_[end + 1]; ++x) {
      const Face f = sides_[x].face;
      if (f == kNone) continue;
      const auto mate =
          std::find_if(sides_.begin() + static_cast<std::ptrdiff_t>(x) + 1, sides_.begin() + first_[end + 1],
                       [&](const Side& side) { return side.other == sides_[x].other && side.face != kNone; });
      if (mate == sides_.begin() + first_[end + 1]) continue;
      const Face g = std::exchange(mate->face, kNone);
      new_tets[number_of_new(f)].neighbours[f & 3u] = g;
      new_tets[number_of_new(g)].neighbours[g & 3u] = f;
    }
}

}  // namespace holdfast
