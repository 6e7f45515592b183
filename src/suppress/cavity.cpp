#include "suppress/cavity.h"

#include <algorithm>

namespace holdfast {

Cavity::Cavity(const TetMesh& mesh, std::span<const Tet> ball)
    : mesh_(mesh), tets_(ball.begin(), ball.end()) {
  collect_faces();
}

bool Cavity::grow(std::mt19937_64& random) {
  const std::vector<Tet> candidates = neighbours(random);
  return std::any_of(candidates.begin(), candidates.end(), [&](Tet t) { return add(t); });
}

bool Cavity::grow_across(std::size_t k) { return add(across_[k]); }

bool Cavity::add(Tet t) {
  if (!may_add(t)) return false;
  tets_.push_back(t);
  collect_faces();
  const auto& v = mesh_.corners(t);
  bool encloses = std::any_of(v.begin(), v.end(), [&](Vertex x) { return !on_boundary(x); });
  for (int k = 0; k < 6; ++k) {
    const auto& e = kEdgeVertex[static_cast<std::size_t>(k)];
    encloses =
        encloses || (mesh_.is_segment(t, k) && !on_boundary(mesh_.corner(t, e[0]), mesh_.corner(t, e[1])));
  }
  if (!encloses) return true;
  tets_.pop_back();
  collect_faces();
  return false;
}

std::size_t Cavity::vertex_count() const {
  std::vector<Vertex> vertices;
  for (const auto& f : faces_) vertices.insert(vertices.end(), f.begin(), f.end());
  std::sort(vertices.begin(), vertices.end());
  return static_cast<std::size_t>(std::unique(vertices.begin(), vertices.end()) - vertices.begin());
}

bool Cavity::holds(Tet t) const { return std::find(tets_.begin(), tets_.end(), t) != tets_.end(); }

bool Cavity::may_add(Tet t) const {
  for (int i = 0; i < 4; ++i)
    if (mesh_.is_facet(face_code(t, i)) && holds(tet_of(mesh_.neighbour(t, i)))) return false;
  return !mesh_.is_ghost(t);
}

bool Cavity::on_boundary(Vertex v) const {
  return std::any_of(faces_.begin(), faces_.end(),
                     [&](const auto& f) { return f[0] == v || f[1] == v || f[2] == v; });
}

bool Cavity::on_boundary(Vertex u, Vertex v) const {
  return std::any_of(faces_.begin(), faces_.end(), [&](const auto& f) {
    return std::find(f.begin(), f.end(), u) != f.end() && std::find(f.begin(), f.end(), v) != f.end();
  });
}

// Across the faces, each once, in random order but those without a new vertex first.
std::vector<Tet> Cavity::neighbours(std::mt19937_64& random) const {
  std::vector<Tet> out = across_;
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  std::shuffle(out.begin(), out.end(), random);
  std::stable_partition(out.begin(), out.end(), [&](Tet t) {
    const auto& v = mesh_.corners(t);
    return std::all_of(v.begin(), v.end(), [&](Vertex x) { return on_boundary(x); });
  });
  return out;
}

void Cavity::collect_faces() {
  faces_.clear();
  across_.clear();
  for (const Tet t : tets_)
    for (int i = 0; i < 4; ++i) {
      const Tet s = tet_of(mesh_.neighbour(t, i));
      if (holds(s)) continue;
      faces_.push_back(mesh_.face_vertices(face_code(t, i)));
      across_.push_back(s);
    }
}

}  // namespace holdfast
