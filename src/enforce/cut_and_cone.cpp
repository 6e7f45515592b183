#include "enforce/cut_and_cone.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include "enforce/fictitious_cut.h"
#include "enforce/polygon.h"
#include "mesh/editor.h"
#include "mesh/kernel.h"
#include "mesh/measure.h"
#include "mesh/traverse.h"
#include "numbers/sorted.h"

namespace holdfast {
namespace {

// A polygon of constraint faces through P: its corners in the plane without P, and its triangles, which have
// the same orientation as the corners.
struct Cut {
  std::vector<Vertex> path;
  bool facet = true;  // else fictitious
  std::vector<Triangle> triangles;
};

// A connected part of the link between the cuts.
struct Sector {
  std::vector<Triangle> faces;  // orient(f, P) > 0
  struct Side {
    std::size_t cut;
    bool along;  // whether the cut's triangles, as oriented, see the sector's inside positively
  };
  std::vector<Side> sides;
};

// The ball of P with its constraint faces.
class BallCutter {
 public:
  BallCutter(TetMesh& mesh, Vertex p, std::optional<std::array<Vertex, 2>> ends,
             const std::vector<CutPath>& fictitious)
      : mesh_(mesh), p_(p), ends_(ends) {
    ball(mesh, p, tets_);
    collect_cut_edges();
    ends ? trace_paths() : trace_cycle();
    for (const CutPath& path : fictitious) {
      cuts_.push_back({path, false, {}});
      for (std::size_t k = 0; k + 1 < path.size(); ++k)
        fictitious_edges_.push_back(ascending(Edge{path[k], path[k + 1]}));
    }
    find_sectors();
    for (std::size_t c = 0; c < cuts_.size(); ++c)
      cuts_[c].triangles = triangulate_polygon(mesh_, cuts_[c].path, above_[c].vertex);
  }

  [[nodiscard]] const std::vector<Tet>& tets() const { return tets_; }
  [[nodiscard]] const std::vector<Cut>& cuts() const { return cuts_; }
  [[nodiscard]] const std::vector<Sector>& sectors() const { return sectors_; }

 private:
  using Edge = std::array<Vertex, 2>;

  void collect_cut_edges() {
    for (const Tet t : tets_)
      for (int i = 0; i < 4; ++i) {
        const Vertex w = mesh_.corner(t, i);
        if (w == p_ || !mesh_.is_facet(face_code(t, i))) continue;
        const Edge e = link_edge(t, w);
        next_[e[0]].push_back(e[1]);  // the tetrahedron on the other side adds the reverse
      }
    for (auto& [v, to] : next_) sort_unique(to);
  }

  // The link edge of t opposite w, directed like t's link face: orient(e0, e1, w, P) > 0.
  [[nodiscard]] Edge link_edge(Tet t, Vertex w) const { return mesh_.opposite_edge(t, w, p_); }

  void trace_cycle() {
    if (next_.empty()) throw std::logic_error("holdfast: no facet through a facet point");
    Cut cut;
    const Vertex start = next_.begin()->first;
    Vertex previous = kNone;
    Vertex v = start;
    do {
      cut.path.push_back(v);
      previous = std::exchange(v, following(previous, v));
    } while (v != start);
    if (cut.path.size() != next_.size()) throw std::logic_error("holdfast: two facets through a facet point");
    cuts_.push_back(std::move(cut));
  }

  void trace_paths() {
    const auto [a, b] = *ends_;
    const auto at_a = next_.find(a);
    if (at_a == next_.end()) return;
    for (const Vertex first : at_a->second) {
      Cut cut;
      cut.path = {a};
      Vertex previous = a;
      Vertex v = first;
      while (v != b) {
        cut.path.push_back(v);
        previous = std::exchange(v, following(previous, v));
      }
      cut.path.push_back(b);
      cuts_.push_back(std::move(cut));
    }
  }

  // The vertex after v on the border of the facet faces at P, coming from `previous`.
  [[nodiscard]] Vertex following(Vertex previous, Vertex v) const {
    const auto& to = next_.at(v);
    if (to.size() != 2)
      throw std::logic_error(ends_ ? "holdfast: the facet faces at a segment point are no fan"
                                   : "holdfast: the facet faces at a facet point are no disc");
    return to[0] != previous ? to[0] : to[1];
  }

  void find_sectors() {
    const SidesOfEdges side_of = sides_of_cut_edges();
    above_.assign(cuts_.size(), {});
    for (const Tet t : tets_) mesh_.mark_visited(t);  // marked: in the ball, not yet in a sector
    for (const Tet seed : tets_)
      if ((mesh_.flags(seed) & kVisited) != 0) sectors_.push_back(flood(seed, side_of));
    check_sectors();
  }

  // By directed edge of a cut: the side of the cut on which the edge bounds a sector.
  using SidesOfEdges = std::map<Edge, Sector::Side>;

  [[nodiscard]] SidesOfEdges sides_of_cut_edges() const {
    SidesOfEdges side_of;
    for (std::size_t c = 0; c < cuts_.size(); ++c) {
      const auto& path = cuts_[c].path;
      const std::size_t edges = ends_ ? path.size() - 1 : path.size();
      for (std::size_t k = 0; k < edges; ++k) {
        const Vertex r = path[k];
        const Vertex s = path[(k + 1) % path.size()];
        // In a tetrahedron with orient(r, s, w, P) > 0 the face seen from w positively turns s, r.
        side_of[{r, s}] = {c, false};
        side_of[{s, r}] = {c, true};
      }
    }
    return side_of;
  }

  // The sector of a tetrahedron of the ball: all that can be reached without crossing a cut.
  Sector flood(Tet seed, const SidesOfEdges& side_of) {
    Sector sector;
    std::vector<Tet> stack{seed};
    mesh_.clear_visited(seed);
    while (!stack.empty()) {
      const Tet t = stack.back();
      stack.pop_back();
      sector.faces.push_back(mesh_.face_vertices(face_code(t, mesh_.index_of(t, p_))));
      for (int i = 0; i < 4; ++i) {
        const Vertex w = mesh_.corner(t, i);
        if (w == p_) continue;
        const Edge e = link_edge(t, w);
        if (is_cut(t, i, e)) {
          const Sector::Side side = side_of.at(e);
          add_side(sector, side);
          if (side.along) note_above(side.cut, e, w);
          continue;
        }
        const Tet n = tet_of(mesh_.neighbour(t, i));
        if ((mesh_.flags(n) & kVisited) == 0) continue;
        mesh_.clear_visited(n);
        stack.push_back(n);
      }
    }
    return sector;
  }

  [[nodiscard]] bool is_cut(Tet t, int face, const Edge& link_edge) const {
    return mesh_.is_facet(face_code(t, face)) || std::find(fictitious_edges_.begin(), fictitious_edges_.end(),
                                                           ascending(link_edge)) != fictitious_edges_.end();
  }

  static void add_side(Sector& sector, Sector::Side side) {
    for (const Sector::Side& s : sector.sides)
      if (s.cut == side.cut && s.along == side.along) return;
    sector.sides.push_back(side);
  }

  // Notes a vertex strictly off the cut's plane, as far away as possible; the turns of the polygon are
  // computed from it.
  void note_above(std::size_t cut, const Edge& e, Vertex w) {
    const double height = height_over(mesh_, e[0], e[1], p_, w);
    if (above_[cut].vertex != kNone && height <= above_[cut].height) return;
    above_[cut] = {w, height};
  }

  void check_sectors() const {
    const std::size_t wanted = ends_ ? cuts_.size() : 2;
    bool right = sectors_.size() == wanted;
    for (const Sector& s : sectors_) right = right && s.sides.size() == (ends_ ? 2u : 1u);
    if (!right) throw std::logic_error("holdfast: the constraints at a partition point do not cut its ball");
  }

  TetMesh& mesh_;
  Vertex p_;
  std::optional<std::array<Vertex, 2>> ends_;
  std::vector<Tet> tets_;
  std::map<Vertex, std::vector<Vertex>> next_;
  std::vector<Edge> fictitious_edges_;
  std::vector<Cut> cuts_;
  struct Above {
    Vertex vertex = kNone;
    double height = 0;
  };
  std::vector<Above> above_;  // by cut: a vertex strictly off its plane
  std::vector<Sector> sectors_;
};

// The faces that a sector's apex must see.
Kernel kernel_of(const TetMesh& mesh, const Sector& sector, const std::vector<Cut>& cuts) {
  Kernel kernel(mesh);
  for (const auto& f : sector.faces) kernel.add(f[0], f[1], f[2]);
  for (const Sector::Side& side : sector.sides)
    for (const auto& t : cuts[side.cut].triangles)
      side.along ? kernel.add(t[0], t[1], t[2]) : kernel.add(t[2], t[1], t[0]);
  return kernel;
}

}  // namespace

std::vector<Vertex> cut_and_cone(TetMesh& mesh, Vertex p, std::optional<std::array<Vertex, 2>> ends) {
  std::vector<Vertex> created;
  const std::vector<CutPath> fictitious =
      ends ? fictitious_cuts(mesh, p, *ends, created) : std::vector<CutPath>{};
  const BallCutter cutter(mesh, p, ends, fictitious);
  std::vector<TetMesh::Corners> fresh;
  std::vector<Triangle> facets;
  for (const Sector& sector : cutter.sectors()) {
    const Kernel kernel = kernel_of(mesh, sector, cutter.cuts());
    Vertex apex = best_apex(mesh, kernel);
    if (apex == kNone) {
      const auto position = kernel.find(mesh.point(p));
      // P is on one or two of the planes that the sector must see, and strictly before all others; so the
      // kernel finds a place.
      if (!position) throw std::logic_error("holdfast: a sector has no kernel");
      apex = MeshEditor(mesh).add_vertex(*position);
      created.push_back(apex);
    }
    for (const auto& f : kernel.faces())
      if (f[0] != apex && f[1] != apex && f[2] != apex) fresh.push_back({f[0], f[1], f[2], apex});
  }
  for (const Cut& cut : cutter.cuts())
    if (cut.facet) facets.insert(facets.end(), cut.triangles.begin(), cut.triangles.end());
  std::vector<std::array<Vertex, 2>> segments;
  if (ends) segments.push_back(*ends);
  MeshEditor(mesh).replace(
      {.old_tets = cutter.tets(), .new_tets = fresh, .facets = facets, .segments = segments});
  MeshEditor(mesh).remove_vertex(p);
  return created;
}

}  // namespace holdfast
