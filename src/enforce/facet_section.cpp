#include "enforce/facet_section.h"

#include <algorithm>
#include <stdexcept>
#include <unordered_map>
#include <unordered_set>

#include "mesh/keys.h"
#include "mesh/traverse.h"
#include "numbers/sorted.h"

namespace holdfast {
namespace {

class Flood {
 public:
  Flood(TetMesh& mesh, const FacetFrame& frame) : mesh_(mesh), frame_(frame) {
    for (const auto& side : frame.sides)
      for (std::size_t k = 0; k < side.size(); ++k) {
        sign_[side[k]] = 0;
        on_border_.insert(side[k]);
        if (k > 0) seen_edges_.insert(edge_key(side[k - 1], side[k]));
      }
  }

  FacetSection run() {
    start();
    while (!tets_.empty() || !edges_.empty()) {
      if (!tets_.empty()) {
        const Tet t = tets_.back();
        tets_.pop_back();
        visit_tet(t);
      } else {
        const InnerEdge e = edges_.back();
        edges_.pop_back();
        visit_edge(e);
      }
    }
    for (const Vertex v : inner_)
      if (!on_border_.contains(v)) section_.inner.push_back(v);
    sort_unique(section_.inner);
    return std::move(section_);
  }

 private:
  struct InnerEdge {
    Vertex a, b;
    Tet tet;
  };

  int sign(Vertex v) {
    const auto [it, fresh] = sign_.try_emplace(v, 0);
    if (fresh) it->second = mesh_.orient(frame_.corners[0], frame_.corners[1], frame_.corners[2], v);
    return it->second;
  }

  // The cell on the facet's side of one side edge: the wedge of the edge's shell that contains the opposite
  // corner, or the coplanar face on that side.
  void start() {
    const Vertex a = frame_.sides[0][0];
    const Vertex b = frame_.sides[0][1];
    const Vertex inside = frame_.corners[0];
    const Tet first = find_edge(mesh_, a, b);
    if (first == kNone) throw std::logic_error("holdfast: a facet's side is no chain of edges");
    std::vector<Tet> ring;
    shell(mesh_, first, a, b, ring);
    for (const Tet t : ring) {
      const auto [c, d] = mesh_.opposite_edge(t, a, b);
      if (mesh_.orient(a, b, inside, d) <= 0) continue;
      const int above_c = mesh_.orient(a, b, c, inside);
      if (above_c > 0) {
        add_tet(t);
        return;
      }
      if (above_c == 0) {
        add_face(face_code(t, mesh_.index_of(t, d)));
        return;
      }
    }
    throw std::logic_error("holdfast: a facet starts nowhere");
  }

  void add_tet(Tet t) {
    if (seen_tets_.insert(t).second) tets_.push_back(t);
  }

  void add_face(Face f) {
    const Face code = std::min(f, mesh_.neighbour(f));
    if (!seen_faces_.insert(code).second) return;
    section_.faces.push_back(code);
    const auto v = mesh_.face_vertices(code);
    for (std::size_t k = 0; k < 3; ++k) add_edge(v[k], v[(k + 1) % 3], tet_of(code));
  }

  void add_edge(Vertex a, Vertex b, Tet t) {
    if (!seen_edges_.insert(edge_key(a, b)).second) return;
    edges_.push_back({a, b, t});
    inner_.push_back(a);
    inner_.push_back(b);
  }

  void visit_tet(Tet t) {
    std::array<int, 4> s{};
    for (int i = 0; i < 4; ++i) s[static_cast<std::size_t>(i)] = sign(mesh_.corner(t, i));
    for (std::size_t i = 0; i < 4; ++i)
      if (s[i] == 0) inner_.push_back(mesh_.corner(t, static_cast<int>(i)));
    for (const auto& e : kEdgeVertex) {
      const auto i = static_cast<std::size_t>(e[0]);
      const auto j = static_cast<std::size_t>(e[1]);
      const Vertex a = mesh_.corner(t, e[0]);
      const Vertex b = mesh_.corner(t, e[1]);
      if (s[i] == 0 && s[j] == 0) {
        add_edge(a, b, t);
      } else if (s[i] * s[j] < 0 && seen_edges_.insert(edge_key(a, b)).second) {
        section_.piercing.push_back(s[i] > 0 ? PiercingEdge{a, b, t} : PiercingEdge{b, a, t});
      }
    }
    for (int i = 0; i < 4; ++i) {
      bool above = false;
      bool below = false;
      for (const int k : kFaceVertex[static_cast<std::size_t>(i)]) {
        above = above || s[static_cast<std::size_t>(k)] > 0;
        below = below || s[static_cast<std::size_t>(k)] < 0;
      }
      if (above && below) add_tet(tet_of(mesh_.neighbour(t, i)));
    }
  }

  // An in-plane edge inside the facet has a cell on each side, somewhere in its shell.
  void visit_edge(const InnerEdge& e) {
    std::vector<Tet> ring;
    shell(mesh_, e.tet, e.a, e.b, ring);
    for (const Tet t : ring) {
      const auto [c, d] = mesh_.opposite_edge(t, e.a, e.b);
      const int of_c = sign(c), of_d = sign(d);
      if (of_c * of_d < 0) add_tet(t);
      if (of_c == 0) add_face(face_code(t, mesh_.index_of(t, d)));
    }
  }

  TetMesh& mesh_;
  const FacetFrame& frame_;
  FacetSection section_;
  std::unordered_map<Vertex, int> sign_;
  std::unordered_set<Vertex> on_border_;
  std::unordered_set<Tet> seen_tets_;
  std::unordered_set<Face> seen_faces_;
  std::unordered_set<EdgeKey> seen_edges_;
  std::vector<Tet> tets_;
  std::vector<InnerEdge> edges_;
  std::vector<Vertex> inner_;
};

}  // namespace

FacetSection facet_section(TetMesh& mesh, const FacetFrame& frame) { return Flood(mesh, frame).run(); }

}  // namespace holdfast
