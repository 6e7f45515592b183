#include "literal/soup.h"

#include <algorithm>

#include "mesh/editor.h"

namespace holdfast::literal {

int parity(const TetMesh::Corners& t, const TetMesh::Corners& q) {
  std::array<std::ptrdiff_t, 4> place{};
  for (std::size_t i = 0; i < 4; ++i) place[i] = std::find(t.begin(), t.end(), q[i]) - t.begin();
  int sign = 1;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j)
      if (place[i] > place[j]) sign = -sign;
  return sign;
}

Soup::Soup(TetMesh& mesh) : mesh_(mesh), at_(mesh.vertex_count()) {
  for (Tet t = 0; t < mesh.slot_count(); ++t)
    if (mesh.alive(t) && !mesh.is_ghost(t)) add(mesh.corners(t));
}

bool Soup::has_edge(Vertex a, Vertex b) const {
  return std::any_of(at_[a].begin(), at_[a].end(), [&](Number t) {
    return std::find(tets_[t].begin(), tets_[t].end(), b) != tets_[t].end();
  });
}

Soup::Number Soup::add(const Corners& corners) {
  const auto t = static_cast<Number>(tets_.size());
  tets_.push_back(corners);
  alive_.push_back(true);
  for (const Vertex v : corners) at_[v].push_back(t);
  return t;
}

void Soup::remove(Number t) {
  alive_[t] = false;
  for (const Vertex v : tets_[t]) std::erase(at_[v], t);
}

Vertex Soup::copy(Vertex v) {
  const Vertex w = MeshEditor(mesh_).add_vertex(mesh_.exact_position(v));
  at_.resize(mesh_.vertex_count());
  return w;
}

std::optional<Index> Soup::facet_of(const std::array<Vertex, 3>& face) const {
  const auto found = facets_.find(face_key(face));
  return found == facets_.end() ? std::nullopt : std::optional(found->second);
}

Soup::Counts Soup::count() const {
  Counts counts;
  for (Number t = 0; t < tets_.size(); ++t) {
    if (!alive_[t]) continue;
    const auto& [a, b, c, d] = tets_[t];
    const int sign = mesh_.orient(a, b, c, d);
    ++(sign > 0 ? counts.positive : sign == 0 ? counts.null : counts.negative);
  }
  return counts;
}

}  // namespace holdfast::literal
