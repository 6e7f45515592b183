#include "api/improve_tangle.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "mesh/editor.h"
#include "mesh/keys.h"
#include "numbers/sorted.h"

namespace holdfast {
namespace {

// A tangle as a mesh with a hull of ghosts, whose vertices that stand come first.
class AsMesh {
 public:
  AsMesh(const Tangle& tangle, const exact::DoubleGrid& grid, std::uint64_t seed)
      : tangle_(tangle), seed_(seed) {
    MeshEditor(mesh_).set_grid(grid);
    number_vertices();
    read_tetrahedra();
    add_ghosts();
    link_ghosts();
    MeshEditor(mesh_).load(std::move(corners_), std::move(neighbours_));
    mark_constraints();
    set_sizes();
  }

  [[nodiscard]] VolumeData data() {
    return {mesh_, region_of_, sizes_, kept_, first_free_, nullptr, nullptr, seed_, nullptr};
  }

  // New vertices of the mesh come after all of the tangle.
  [[nodiscard]] Tangle tangle() {
    std::vector<Point> points;
    for (Vertex v = 0; v < tangle_.vertex_count(); ++v) points.push_back(tangle_.position(v));
    for (Vertex v = static_cast<Vertex>(number_.size()); v < mesh_.vertex_count(); ++v) {
      number_.push_back(static_cast<Vertex>(points.size()));
      points.emplace_back();
    }
    for (Vertex v = first_free_; v < mesh_.vertex_count(); ++v)
      if (mesh_.in_mesh(v)) points[number_[v]] = mesh_.position(v);
    std::vector<Tangle::Corners> tets;
    std::vector<int> regions;
    for (Tet t = 0; t < mesh_.slot_count(); ++t) {
      if (!data().is_inside(t)) continue;
      const TetMesh::Corners& c = mesh_.corners(t);
      tets.push_back({number_[c[0]], number_[c[1]], number_[c[2]], number_[c[3]]});
      regions.push_back(ids_[region_of_[t]]);
    }
    Constraints constraints = tangle_.constraints();
    constraints.fixed.resize(points.size(), false);
    return {points, std::move(tets), std::move(regions), std::move(constraints), mesh_.grid()};
  }

 private:
  void number_vertices() {
    std::vector<Vertex> of_tangle(tangle_.vertex_count(), kNone);
    for (const bool fixed : {true, false}) {
      for (Vertex v = 0; v < tangle_.vertex_count(); ++v) {
        if (tangle_.star(v).empty() || tangle_.is_fixed(v) != fixed) continue;
        of_tangle[v] = MeshEditor(mesh_).add_vertex(tangle_.position(v));
        number_.push_back(v);
      }
      if (fixed) first_free_ = static_cast<Vertex>(number_.size());
    }
    of_tangle_ = std::move(of_tangle);
  }

  void read_tetrahedra() {
    slot_.assign(tangle_.slot_count(), kNone);
    ids_ = {0};  // of the outside
    for (Tet t = 0; t < tangle_.slot_count(); ++t) {
      if (!tangle_.alive(t)) continue;
      slot_[t] = static_cast<Tet>(corners_.size());
      const Tangle::Corners& c = tangle_.corners(t);
      corners_.push_back({of_tangle_[c[0]], of_tangle_[c[1]], of_tangle_[c[2]], of_tangle_[c[3]]});
      tets_.push_back(t);
      ids_.push_back(tangle_.region(t));
    }
    std::sort(ids_.begin() + 1, ids_.end());
    ids_.erase(std::unique(ids_.begin() + 1, ids_.end()), ids_.end());
    for (const Tet t : tets_)
      region_of_.push_back(static_cast<RegionId>(
          std::lower_bound(ids_.begin() + 1, ids_.end(), tangle_.region(t)) - ids_.begin()));
    kept_.assign(ids_.size(), true);
    kept_[0] = false;
    neighbours_.resize(corners_.size());
  }

  void add_ghosts() {
    for (Tet k = 0; k < tets_.size(); ++k)
      for (int i = 0; i < 4; ++i) {
        const Tet other = tangle_.across(tets_[k], i);
        Face& across = neighbours_[k][static_cast<std::size_t>(i)];
        if (other != kNone) {
          across = face_of(slot_[other], face_key(corners_[k], i));
          continue;
        }
        const auto ghost = static_cast<Tet>(corners_.size());
        across = face_code(ghost, 3);
        const auto v = corners_of_face(corners_[k], i);
        corners_.push_back({v[0], v[2], v[1], kGhost});
        neighbours_.push_back({kNone, kNone, kNone, face_code(k, i)});
        region_of_.push_back(0);
      }
  }

  [[nodiscard]] Face face_of(Tet k, const FaceKey& key) const {
    int i = 0;
    while (i < 3 && face_key(corners_[k], i) != key) ++i;
    return face_code(k, i);
  }

  [[nodiscard]] int index_of(Tet k, Vertex v) const {
    return static_cast<int>(std::find(corners_[k].begin(), corners_[k].end(), v) - corners_[k].begin());
  }

  // Two are neighbours where turning round their edge, through the mesh, leads from one to the other.
  void link_ghosts() {
    for (auto ghost = static_cast<Tet>(tets_.size()); ghost < corners_.size(); ++ghost)
      for (int j = 0; j < 3; ++j) {
        Face in = neighbours_[ghost][3];
        Vertex across = corners_[ghost][static_cast<std::size_t>(j)];
        while (tet_of(in) < tets_.size()) {
          const Vertex apex = corners_[tet_of(in)][static_cast<std::size_t>(side_of(in))];
          in = neighbours_[tet_of(in)][static_cast<std::size_t>(index_of(tet_of(in), across))];
          across = apex;
        }
        neighbours_[ghost][static_cast<std::size_t>(j)] = face_code(tet_of(in), index_of(tet_of(in), across));
      }
  }

  void mark_constraints() {
    const Constraints& c = tangle_.constraints();
    std::vector<EdgeKey> edges;
    for (const auto& [a, b] : c.segments) edges.push_back(edge_key(a, b));
    for (const auto& f : c.faces)
      for (std::size_t k = 0; k < 3; ++k) edges.push_back(edge_key(f[k], f[(k + 1) % 3]));
    sort_unique(edges);
    for (Tet t = 0; t < mesh_.slot_count(); ++t) {
      const auto vertex = [&](int i) {
        return mesh_.corner(t, i) == kGhost ? kNone : number_[mesh_.corner(t, i)];
      };
      Flags flags = 0;
      for (int i = 0; i < 4; ++i) {
        const auto& f = kFaceVertex[static_cast<std::size_t>(i)];
        if (mesh_.is_ghost(t) ? i == 3 : tangle_.is_constraint({vertex(f[0]), vertex(f[1]), vertex(f[2])}))
          flags = static_cast<Flags>(flags | facet_bit(i));
      }
      for (int k = 0; k < 6; ++k) {
        const auto& e = kEdgeVertex[static_cast<std::size_t>(k)];
        if (vertex(e[0]) != kNone && vertex(e[1]) != kNone &&
            std::binary_search(edges.begin(), edges.end(), edge_key(vertex(e[0]), vertex(e[1]))))
          flags = static_cast<Flags>(flags | segment_bit(k));
      }
      MeshEditor(mesh_).mark_constraints(t, flags);
    }
    MeshEditor(mesh_).finish();
  }

  // The mean length of the edges at each vertex, an edge once for each element.
  void set_sizes() {
    sizes_.assign(mesh_.vertex_count(), 0);
    std::vector<std::size_t> count(mesh_.vertex_count(), 0);
    for (Tet t = 0; t < tets_.size(); ++t)
      for (int k = 0; k < 6; ++k) {
        const auto ends = ends_of_edge(mesh_.corners(t), k);
        for (const Vertex v : ends) {
          sizes_[v] += distance(mesh_.position(ends[0]), mesh_.position(ends[1]));
          ++count[v];
        }
      }
    for (Vertex v = 0; v < sizes_.size(); ++v)
      if (count[v] > 0) sizes_[v] /= static_cast<double>(count[v]);
  }

  const Tangle& tangle_;
  const std::uint64_t seed_;
  TetMesh mesh_;
  std::vector<TetMesh::Corners> corners_;
  std::vector<TetMesh::Neighbours> neighbours_;
  std::vector<Vertex> of_tangle_, number_;  // in the mesh, by vertex of the tangle; and the other way
  std::vector<Tet> slot_, tets_;            // the same of tetrahedra
  std::vector<RegionId> region_of_;
  std::vector<int> ids_;  // by region of the mesh
  std::vector<bool> kept_;
  std::vector<double> sizes_;
  Vertex first_free_ = 0;
};

}  // namespace

ImprovedTangle improve_tangle(Tangle& tangle, const exact::DoubleGrid& grid, std::uint64_t seed,
                              Monitor& monitor) {
  AsMesh as_mesh(tangle, grid, seed);
  ImprovedTangle improved;
  improved.before = figures_of(as_mesh.data());
  for (const Effort effort : {Effort::fast, Effort::good})
    improved.stats += improve_further(as_mesh.data(), effort, {0, 1}, 1, monitor);
  improved.after = figures_of(as_mesh.data());
  tangle = as_mesh.tangle();
  return improved;
}

}  // namespace holdfast
