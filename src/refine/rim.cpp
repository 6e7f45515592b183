#include "refine/rim.h"

#include <algorithm>

namespace holdfast {
namespace {

// The corners of a side.
constexpr std::array<std::array<std::size_t, 2>, 3> kSide{{{1, 2}, {2, 0}, {0, 1}}};

}  // namespace

void RimEdges::list(std::span<const RimFace> rim, const RimVertices& vertices) {
  edges_.clear();
  if (fits_table(vertices)) {
    const std::size_t n = vertices.size();
    if (table_.size() < n * n) table_.resize(n * n);
    for (std::uint32_t k = 0; k < rim.size(); ++k)
      for (std::uint32_t i = 0; i < 3; ++i)
        table_[rim[k].local[kSide[i][0]] * n + rim[k].local[kSide[i][1]]] = face_code(k, static_cast<int>(i));
    return;
  }
  for (const RimFace& r : rim)
    for (std::size_t i = 0; i < 3; ++i) edges_.push_back(edge_key(r.v[i], r.v[(i + 1) % 3]));
  std::sort(edges_.begin(), edges_.end());
}

bool RimEdges::has(std::span<const RimFace> rim, const RimVertices& vertices, Vertex a, Vertex b) const {
  if (!fits_table(vertices)) return std::binary_search(edges_.begin(), edges_.end(), edge_key(a, b));
  if (!vertices.has(a) || !vertices.has(b)) return false;
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
    link_by_sorting(rim, new_tets);
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

void RimEdges::link_by_sorting(std::span<const RimFace> rim, std::span<NewTet> new_tets) {
  sides_.clear();
  for (std::size_t k = 0; k < rim.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i)
      sides_.push_back({edge_key(rim[k].local[(i + 1) % 3], rim[k].local[(i + 2) % 3]), new_face(k, i)});
  std::sort(sides_.begin(), sides_.end(), [](const Side& x, const Side& y) {
    return x.edge != y.edge ? x.edge < y.edge : x.face < y.face;
  });
  for (std::size_t k = 0; k + 1 < sides_.size(); k += 2) {
    const Face f = sides_[k].face, g = sides_[k + 1].face;
    new_tets[number_of_new(f)].neighbours[f & 3u] = g;
    new_tets[number_of_new(g)].neighbours[g & 3u] = f;
  }
}

}  // namespace holdfast
