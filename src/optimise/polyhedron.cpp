#include "optimise/polyhedron.h"

#include <algorithm>
#include <array>
#include <utility>

#include "mesh/editor.h"
#include "mesh/quality.h"
#include "mesh/quality_below.h"
#include "numbers/sorted.h"
#include "numbers/vector.h"
#include "optimise/badness.h"
#include "optimise/search.h"

namespace holdfast {

Polyhedron::Polyhedron(Search& search, std::vector<Tet> from, std::size_t most)
    : mesh_(search.mesh()), tets_(std::move(from)) {
  gather(search, most);
  cut_out(search.first_free());
  for (const Tet t : tets_) mesh_.clear_visited(t);
}

void Polyhedron::gather(const Search& search, std::size_t most) {
  for (const Tet t : tets_) mesh_.mark_visited(t);
  for (std::size_t k = 0; k < tets_.size(); ++k)
    for (const Face across : mesh_.neighbours(tets_[k])) {
      if (tets_.size() >= most) return;
      const Tet next = tet_of(across);
      if (mesh_.is_facet(across) || mesh_.is_ghost(next) || !search.is_ours(next) ||
          (mesh_.flags(next) & kVisited) != 0)
        continue;
      mesh_.mark_visited(next);
      tets_.push_back(next);
    }
}

void Polyhedron::cut_out(Vertex first_free) {
  std::set<FaceKey> walls;
  std::set<EdgeKey> segments;
  std::vector<Vertex> free;
  for (const Tet t : tets_) {
    cut_out_faces(t, walls);
    for (const Vertex v : mesh_.corners(t)) (v < first_free ? vertices_ : free).push_back(v);
    for (int k = 0; k < 6; ++k)
      if (mesh_.is_segment(t, k)) segments.insert(edge_key(mesh_.corners(t), k));
  }
  for (const auto& f : facets_) vertices_.insert(vertices_.end(), f.begin(), f.end());
  sort_unique(vertices_);
  sort_unique(free);
  points_ = static_cast<std::size_t>(std::count_if(free.begin(), free.end(), [&](Vertex v) {
    return !std::binary_search(vertices_.begin(), vertices_.end(), v);
  }));
  for (const Vertex v : vertices_) surface_.vertices.push_back(mesh_.position(v));
  for (const auto& f : facets_) {
    surface_.facets.push_back({local(f[0]), local(f[1]), local(f[2])});
    // The sides of a facet are constraints already.
    for (std::size_t i = 0; i < 3; ++i) segments.erase(edge_key(f[i], f[(i + 1) % 3]));
  }
  for (const EdgeKey e : segments)
    surface_.segments.push_back({local(static_cast<Vertex>(e >> 32)), local(static_cast<Vertex>(e))});
}

// `walls` are the facets found so far with the polyhedron on both sides.
void Polyhedron::cut_out_faces(Tet t, std::set<FaceKey>& walls) {
  for (int i = 0; i < 4; ++i) {
    const Face f = face_code(t, i);
    const FaceKey key = face_key(mesh_.face_vertices(f));
    const bool is_outer = (mesh_.flags(tet_of(mesh_.neighbour(f))) & kVisited) == 0;
    if (is_outer)
      faces_.insert(key);
    else if (!mesh_.is_facet(f) || !walls.insert(key).second)
      continue;
    const auto [a, b, c] = mesh_.face_vertices(f);
    facets_.push_back({a, c, b});
    apexes_.push_back(mesh_.apex(f));
  }
}

Index Polyhedron::local(Vertex v) const {
  return static_cast<Index>(std::lower_bound(vertices_.begin(), vertices_.end(), v) - vertices_.begin());
}

bool Polyhedron::may_be_filled_below(double limit) const {
  for (std::size_t k = 0; k < facets_.size(); ++k) {
    const auto [a, b, c] = surface_.facets[k];
    const Point &p = surface_.vertices[a], &q = surface_.vertices[b], &r = surface_.vertices[c];
    const auto suits = [&](const Point& apex) { return is_quality_below(p, q, r, apex, limit); };
    if (suits(mesh_.position(apexes_[k]))) continue;
    const Vector outward = cross(q - p, r - p);
    const auto suits_inside = [&](const Point& apex) { return !(dot(outward, apex - p) > 0) && suits(apex); };
    if (std::none_of(surface_.vertices.begin(), surface_.vertices.end(), suits_inside)) return false;
  }
  return true;
}

double Polyhedron::worst() const {
  double worst = 0;
  for (const Tet t : tets_) worst = std::max(worst, quality_of(mesh_, mesh_.corners(t)));
  return worst;
}

double Polyhedron::worst(const Filling& filling) const {
  const auto at = [&](Index v) -> const Point& {
    return v < vertices_.size() ? surface_.vertices[v] : filling.added[v - vertices_.size()];
  };
  double worst = 0;
  for (const Tetrahedron& t : filling.tetrahedra)
    worst = std::max(worst, quality(at(t[0]), at(t[1]), at(t[2]), at(t[3])));
  return worst;
}

bool Polyhedron::is_filled_by(const Filling& filling) const {
  std::set<FaceKey> open;  // faces of the filling found once
  std::vector<bool> has(vertices_.size(), false);
  for (const Tetrahedron& t : filling.tetrahedra)
    for (int i = 0; i < 4; ++i) {
      if (const Index v = t[static_cast<std::size_t>(i)]; v < has.size()) has[v] = true;
      const auto [at, is_new] = open.insert(face_key(t, i));
      if (!is_new) open.erase(at);
    }
  const auto is_open = [&](const FaceKey& f) {
    return open.contains(FaceKey{local(f[0]), local(f[1]), local(f[2])});
  };
  return open.size() == faces_.size() && std::all_of(faces_.begin(), faces_.end(), is_open) &&
         std::all_of(has.begin(), has.end(), [](bool x) { return x; });
}

std::optional<std::vector<Vertex>> Polyhedron::replace(const Filling& filling) const {
  MeshEditor editor(mesh_);
  std::vector<Vertex> number = vertices_;
  for (const Point& p : filling.added) number.push_back(editor.add_vertex(p));
  std::vector<TetMesh::Corners> fresh;
  for (const Tetrahedron& t : filling.tetrahedra)
    fresh.push_back({number[t[0]], number[t[1]], number[t[2]], number[t[3]]});
  const bool is_positive = std::all_of(fresh.begin(), fresh.end(), [&](const TetMesh::Corners& c) {
    return mesh_.orient(c[0], c[1], c[2], c[3]) > 0;
  });
  if (!is_positive) {
    for (std::size_t k = 0; k < filling.added.size(); ++k) editor.remove_last_vertex();
    return std::nullopt;
  }
  editor.replace({.old_tets = tets_, .new_tets = fresh});
  return std::vector<Vertex>(number.begin() + static_cast<std::ptrdiff_t>(vertices_.size()), number.end());
}

}  // namespace holdfast
