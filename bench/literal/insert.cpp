#include "literal/insert.h"

#include <algorithm>
#include <map>
#include <set>

#include "mesh/editor.h"
#include "mesh/keys.h"
#include "mesh/traverse.h"

namespace holdfast::literal {
namespace {

class Star {
 public:
  Star(TetMesh& mesh, Vertex p) : mesh_(mesh), p_(p) {
    std::vector<Tet> tets;
    ball(mesh, p, tets);
    for (const Tet t : tets) {
      cavity_.push_back(t);
      outer_.insert(mesh.neighbour(t, mesh.index_of(t, p)));
      for (const Vertex v : mesh.corners(t)) vertices_.insert(v);
    }
  }

  [[nodiscard]] bool touches_the_hull() const {
    return std::any_of(cavity_.begin(), cavity_.end(), [&](Tet t) { return mesh_.is_ghost(t); });
  }

  // Adds the tetrahedra beyond outer faces for which that holds, while there are any, or in one round.
  template <typename Wanted>
  std::vector<Tet> add(Wanted&& wanted, bool again) {
    std::vector<Tet> added;
    for (bool grown = true; grown;) {
      grown = false;
      const std::vector<Face> faces(outer_.begin(), outer_.end());
      for (const Face f : faces) {
        const Tet t = tet_of(f);
        if (!outer_.contains(f) || mesh_.is_ghost(t) || mesh_.is_facet(f) || !wanted(t) || !fits(t)) continue;
        take(t);
        added.push_back(t);
        grown = again;
      }
    }
    return added;
  }

  void apply(std::vector<TetMesh::Corners>& fresh) {
    for (const Face f : outer_) {
      const auto [a, b, c] = mesh_.face_vertices(f);
      fresh.push_back({a, c, b, p_});
    }
    MeshEditor(mesh_).replace({.old_tets = cavity_, .new_tets = fresh});
  }

 private:
  // The sides of t that are outer faces of the star: one, with a new vertex beyond, or two, whose common edge
  // goes. All other faces must be seen by P.
  [[nodiscard]] bool fits(Tet t) const {
    std::vector<int> shared, others;
    for (int i = 0; i < 4; ++i) (outer_.contains(face_code(t, i)) ? shared : others).push_back(i);
    for (const int i : shared)
      if (mesh_.is_facet(face_code(t, i))) return false;
    if (shared.size() > 2) return false;
    if (shared.size() == 1 && vertices_.contains(mesh_.corner(t, shared[0]))) return false;
    if (shared.size() == 2) {
      const Vertex u = mesh_.corner(t, shared[0]), w = mesh_.corner(t, shared[1]);
      const Vertex x = mesh_.corner(t, others[0]), y = mesh_.corner(t, others[1]);
      if (mesh_.is_segment(t, mesh_.edge_of(t, x, y)) || has_rim_edge(u, w)) return false;
    }
    return std::all_of(others.begin(), others.end(), [&](int i) {
      const auto [a, b, c] = mesh_.face_vertices(face_code(t, i));
      return mesh_.orient(a, b, c, p_) > 0;
    });
  }

  [[nodiscard]] bool has_rim_edge(Vertex u, Vertex w) const {
    return std::any_of(outer_.begin(), outer_.end(), [&](Face f) {
      const auto corners = mesh_.face_vertices(f);
      return std::find(corners.begin(), corners.end(), u) != corners.end() &&
             std::find(corners.begin(), corners.end(), w) != corners.end();
    });
  }

  void take(Tet t) {
    cavity_.push_back(t);
    for (int i = 0; i < 4; ++i)
      if (outer_.erase(face_code(t, i)) == 0) outer_.insert(mesh_.neighbour(t, i));
    for (const Vertex v : mesh_.corners(t)) vertices_.insert(v);
  }

  TetMesh& mesh_;
  const Vertex p_;
  std::vector<Tet> cavity_;
  std::set<Face> outer_;  // as the tetrahedra outside have them
  std::set<Vertex> vertices_;
};

InsertionPicture::Shape shape_of(const TetMesh& mesh, const TetMesh::Corners& corners) {
  const auto& [a, b, c, d] = corners;
  return {mesh.position(a), mesh.position(b), mesh.position(c), mesh.position(d)};
}

std::vector<InsertionPicture::Shape> shapes_of(const TetMesh& mesh, const std::vector<Tet>& tets) {
  std::vector<InsertionPicture::Shape> shapes;
  for (const Tet t : tets) shapes.push_back(shape_of(mesh, mesh.corners(t)));
  return shapes;
}

}  // namespace

void grow_star(TetMesh& mesh, Vertex p, InsertionCounts& counts, InsertionPicture* picture) {
  Star star(mesh, p);
  if (star.touches_the_hull()) return;
  std::vector<Tet> before;
  ball(mesh, p, before);
  const auto in_sphere = [&](Tet t) {
    const auto& [a, b, c, d] = mesh.corners(t);
    return exact::insphere(mesh.position(a).data(), mesh.position(b).data(), mesh.position(c).data(),
                           mesh.position(d).data(), mesh.position(p).data()) > 0;
  };
  const std::vector<Tet> delaunay = star.add(in_sphere, true);
  const std::vector<Tet> visible = star.add([](Tet) { return true; }, false);
  ++counts.points;
  counts.split += before.size();
  counts.delaunay += delaunay.size();
  counts.visible += visible.size();
  if (picture != nullptr)
    *picture = {
        mesh.position(p), shapes_of(mesh, before), shapes_of(mesh, delaunay), shapes_of(mesh, visible), {}};
  if (delaunay.empty() && visible.empty()) return;
  std::vector<TetMesh::Corners> fresh;
  star.apply(fresh);
  if (picture != nullptr)
    for (const TetMesh::Corners& corners : fresh) picture->star.push_back(shape_of(mesh, corners));
}

}  // namespace holdfast::literal
