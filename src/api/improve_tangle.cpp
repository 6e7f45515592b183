#include "api/improve_tangle.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "mesh/editor.h"
#include "mesh/keys.h"
#include "numbers/sorted.h"
#include "optimise/improve_parts.h"

namespace holdfast {
namespace {

// The mesh numbers of a tangle's fixed vertices, which come first, and of the free ones.
struct Numbering {
  std::vector<Vertex> in_mesh;    // by vertex of the tangle, or kNone
  std::vector<Vertex> in_tangle;  // by vertex of the mesh
  Vertex first_free = 0;          // of the mesh
};

Numbering number_vertices(const Tangle& tangle) {
  Numbering number{std::vector<Vertex>(tangle.vertex_count(), kNone), {}, 0};
  for (const bool fixed : {true, false}) {
    for (Vertex v = 0; v < tangle.vertex_count(); ++v) {
      if (tangle.star(v).empty() || tangle.is_fixed(v) != fixed) continue;
      number.in_mesh[v] = static_cast<Vertex>(number.in_tangle.size());
      number.in_tangle.push_back(v);
    }
    if (fixed) number.first_free = static_cast<Vertex>(number.in_tangle.size());
  }
  return number;
}

std::vector<Tet> tetrahedra_of(const Tangle& tangle) {
  std::vector<Tet> tets;
  for (Tet t = 0; t < tangle.slot_count(); ++t)
    if (tangle.alive(t)) tets.push_back(t);
  return tets;
}

// The regions of a mesh.
struct RegionsOfTangle {
  std::vector<int> ids;      // by region; region 0 is the outside
  std::vector<RegionId> of;  // by tetrahedron
  [[nodiscard]] std::vector<bool> kept() const {
    std::vector<bool> kept(ids.size(), true);
    kept[0] = false;
    return kept;
  }
};

// `slots` is the number of the mesh's tetrahedra; those after the tangle's are outside.
RegionsOfTangle regions_of(const Tangle& tangle, std::span<const Tet> tets, std::size_t slots) {
  RegionsOfTangle regions{{}, std::vector<RegionId>(slots, 0)};
  for (const Tet t : tets) regions.ids.push_back(tangle.region(t));
  sort_unique(regions.ids);
  regions.ids.insert(regions.ids.begin(), 0);
  for (std::size_t k = 0; k < tets.size(); ++k)
    regions.of[k] = static_cast<RegionId>(
        std::lower_bound(regions.ids.begin() + 1, regions.ids.end(), tangle.region(tets[k])) -
        regions.ids.begin());
  return regions;
}

// The tetrahedra of a tangle, closed by ghosts and linked to their neighbours.
class WithGhosts {
 public:
  WithGhosts(const Tangle& tangle, std::span<const Tet> tets, const std::vector<Vertex>& in_mesh)
      : tets_(tets) {
    for (const Tet t : tets) {
      const Tangle::Corners& c = tangle.corners(t);
      cells_.push_back({{in_mesh[c[0]], in_mesh[c[1]], in_mesh[c[2]], in_mesh[c[3]]}, {}});
    }
    add_ghosts(tangle);
    link_ghosts();
  }

  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  void move_to(TetMesh& mesh) { MeshEditor(mesh).load(std::move(cells_)); }

 private:
  void add_ghosts(const Tangle& tangle) {
    std::vector<Tet> slot(tangle.slot_count(), kNone);
    for (Tet k = 0; k < tets_.size(); ++k) slot[tets_[k]] = k;
    for (Tet k = 0; k < tets_.size(); ++k)
      for (int i = 0; i < 4; ++i) {
        const Tet other = tangle.across(tets_[k], i);
        Face& across = cells_[k].neighbours[static_cast<std::size_t>(i)];
        if (other != kNone) {
          across = face_of(slot[other], face_key(cells_[k].corners, i));
          continue;
        }
        across = face_code(static_cast<Tet>(cells_.size()), 3);
        const auto v = corners_of_face(cells_[k].corners, i);
        cells_.push_back({{v[0], v[2], v[1], kGhost}, {kNone, kNone, kNone, face_code(k, i)}});
      }
  }

  [[nodiscard]] Face face_of(Tet k, const FaceKey& key) const {
    int i = 0;
    while (i < 3 && face_key(cells_[k].corners, i) != key) ++i;
    return face_code(k, i);
  }

  [[nodiscard]] int index_of(Tet k, Vertex v) const { return index_among(cells_[k].corners, v); }

  // Two ghosts are neighbours if a turn around their edge, through the mesh, leads from one to the other.
  void link_ghosts() {
    for (auto ghost = static_cast<Tet>(tets_.size()); ghost < cells_.size(); ++ghost)
      for (int j = 0; j < 3; ++j) {
        Face in = cells_[ghost].neighbours[3];
        Vertex across = cells_[ghost].corners[static_cast<std::size_t>(j)];
        while (tet_of(in) < tets_.size()) {
          const Vertex apex = cells_[tet_of(in)].corners[static_cast<std::size_t>(side_of(in))];
          in = cells_[tet_of(in)].neighbours[static_cast<std::size_t>(index_of(tet_of(in), across))];
          across = apex;
        }
        cells_[ghost].neighbours[static_cast<std::size_t>(j)] =
            face_code(tet_of(in), index_of(tet_of(in), across));
      }
  }

  std::span<const Tet> tets_;  // of the tangle; their cells come first
  std::vector<TetMesh::Cell> cells_;
};

void mark_constraints(const Tangle& tangle, const std::vector<Vertex>& in_tangle, TetMesh& mesh) {
  const Constraints& c = tangle.constraints();
  std::vector<EdgeKey> edges;
  for (const auto& [a, b] : c.segments) edges.push_back(edge_key(a, b));
  for (const auto& f : c.faces)
    for (std::size_t k = 0; k < 3; ++k) edges.push_back(edge_key(f[k], f[(k + 1) % 3]));
  sort_unique(edges);
  for (Tet t = 0; t < mesh.slot_count(); ++t) {
    const auto vertex = [&](int i) {
      return mesh.corner(t, i) == kGhost ? kNone : in_tangle[mesh.corner(t, i)];
    };
    Flags flags = 0;
    for (int i = 0; i < 4; ++i) {
      const auto& f = kFaceVertex[static_cast<std::size_t>(i)];
      if (mesh.is_ghost(t) ? i == 3 : tangle.is_constraint({vertex(f[0]), vertex(f[1]), vertex(f[2])}))
        flags = static_cast<Flags>(flags | facet_bit(i));
    }
    for (int k = 0; k < 6; ++k) {
      const auto& e = kEdgeVertex[static_cast<std::size_t>(k)];
      if (vertex(e[0]) != kNone && vertex(e[1]) != kNone &&
          std::binary_search(edges.begin(), edges.end(), edge_key(vertex(e[0]), vertex(e[1]))))
        flags = static_cast<Flags>(flags | segment_bit(k));
    }
    MeshEditor(mesh).mark_constraints(t, flags);
  }
  MeshEditor(mesh).finish();
}

// The mean length of the edges at each vertex; an edge counts once for each of its elements.
std::vector<double> sizes_at_vertices(const TetMesh& mesh, Tet tetrahedra) {
  std::vector<double> sizes(mesh.vertex_count(), 0);
  std::vector<std::size_t> count(mesh.vertex_count(), 0);
  for (Tet t = 0; t < tetrahedra; ++t)
    for (int k = 0; k < 6; ++k) {
      const auto ends = ends_of_edge(mesh.corners(t), k);
      for (const Vertex v : ends) {
        sizes[v] += distance(mesh.position(ends[0]), mesh.position(ends[1]));
        ++count[v];
      }
    }
  for (Vertex v = 0; v < sizes.size(); ++v)
    if (count[v] > 0) sizes[v] /= static_cast<double>(count[v]);
  return sizes;
}

// A tangle as a mesh closed by ghosts, with the fixed vertices first.
class AsMesh {
 public:
  AsMesh(const Tangle& tangle, const exact::DoubleGrid& grid, std::uint64_t seed)
      : tangle_(tangle), seed_(seed), number_(number_vertices(tangle)) {
    MeshEditor(mesh_).set_grid(grid);
    for (const Vertex v : number_.in_tangle) MeshEditor(mesh_).add_vertex(tangle.position(v));
    const std::vector<Tet> tets = tetrahedra_of(tangle);
    WithGhosts cells(tangle, tets, number_.in_mesh);
    regions_ = regions_of(tangle, tets, cells.size());
    kept_ = regions_.kept();
    cells.move_to(mesh_);
    mark_constraints(tangle, number_.in_tangle, mesh_);
    sizes_ = sizes_at_vertices(mesh_, static_cast<Tet>(tets.size()));
  }

  [[nodiscard]] VolumeData data() {
    return {mesh_, regions_.of, sizes_, kept_, number_.first_free, nullptr, nullptr, seed_, nullptr};
  }

  // New vertices of the mesh are numbered after all vertices of the tangle.
  [[nodiscard]] Tangle tangle() {
    std::vector<Vertex> number = number_.in_tangle;
    std::vector<Point> points;
    for (Vertex v = 0; v < tangle_.vertex_count(); ++v) points.push_back(tangle_.position(v));
    for (Vertex v = static_cast<Vertex>(number.size()); v < mesh_.vertex_count(); ++v) {
      number.push_back(static_cast<Vertex>(points.size()));
      points.emplace_back();
    }
    for (Vertex v = number_.first_free; v < mesh_.vertex_count(); ++v)
      if (mesh_.in_mesh(v)) points[number[v]] = mesh_.position(v);
    std::vector<Tangle::Corners> tets;
    std::vector<int> regions;
    for (Tet t = 0; t < mesh_.slot_count(); ++t) {
      if (!data().is_inside(t)) continue;
      const TetMesh::Corners& c = mesh_.corners(t);
      tets.push_back({number[c[0]], number[c[1]], number[c[2]], number[c[3]]});
      regions.push_back(regions_.ids[regions_.of[t]]);
    }
    Constraints constraints = tangle_.constraints();
    constraints.fixed.resize(points.size(), false);
    return {points, std::move(tets), std::move(regions), std::move(constraints), mesh_.grid()};
  }

 private:
  const Tangle& tangle_;
  const std::uint64_t seed_;
  const Numbering number_;
  TetMesh mesh_;
  RegionsOfTangle regions_;
  std::vector<bool> kept_;
  std::vector<double> sizes_;
};

}  // namespace

ImprovedTangle improve_tangle(Tangle& tangle, const exact::DoubleGrid& grid, std::uint64_t seed,
                              Monitor& monitor) {
  AsMesh as_mesh(tangle, grid, seed);
  ImprovedTangle improved;
  improved.before = figures_of(as_mesh.data());
  for (const Effort effort : {Effort::fast, Effort::good})
    improved.stats += improve_further_in_parts(as_mesh.data(), effort, std::nullopt, {0, 1}, 1, monitor);
  improved.after = figures_of(as_mesh.data());
  tangle = as_mesh.tangle();
  return improved;
}

}  // namespace holdfast
