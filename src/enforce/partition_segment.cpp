#include "enforce/partition_segment.h"

#include <optional>
#include <stdexcept>

#include "exact/rounding.h"
#include "exact/volume.h"
#include "mesh/editor.h"
#include "mesh/traverse.h"

namespace holdfast {
namespace {

using exact::Dyadic;
using exact::ExactPoint;

// Where the ray from a chain vertex towards B leaves the vertex's ball: through the inside of a face, an
// edge, or a vertex (3, 2 or 1 corners) of the tetrahedron `tet`.
struct Exit {
  Tet tet = kNone;
  std::array<Vertex, 3> corners{};
  int count = 0;
};

Exit find_exit(TetMesh& mesh, Vertex from, Vertex towards) {
  std::vector<Tet> tets;
  ball(mesh, from, tets);
  for (const Tet t : tets) {
    if (mesh.is_ghost(t)) continue;
    const auto [a, b, c] = mesh.face_vertices(face_code(t, mesh.index_of(t, from)));
    // (a b c from) is positive; the ray is inside the cone if it sees no side of the cone from the back.
    const std::array<int, 3> sign{mesh.orient(towards, b, c, from), mesh.orient(a, towards, c, from),
                                  mesh.orient(a, b, towards, from)};
    if (sign[0] < 0 || sign[1] < 0 || sign[2] < 0) continue;
    Exit exit;
    exit.tet = t;
    const std::array<Vertex, 3> face{a, b, c};
    for (std::size_t k = 0; k < 3; ++k)
      if (sign[k] > 0) exit.corners[static_cast<std::size_t>(exit.count++)] = face[k];
    return exit;
  }
  throw std::logic_error("holdfast: a ray leaves a ball nowhere");
}

// The tetrahedra replaced by a point inside a face or edge, and the outer faces that the point must see.
struct Cavity {
  std::vector<Tet> tets;
  std::vector<std::array<Vertex, 3>> faces;  // orient(f0, f1, f2, P) > 0 is wanted
};

Cavity cavity_of(const TetMesh& mesh, const Exit& exit) {
  Cavity cavity;
  const auto corners = std::span(exit.corners).first(static_cast<std::size_t>(exit.count));
  if (exit.count == 2) {
    shell(mesh, exit.tet, corners[0], corners[1], cavity.tets);
  } else {
    int opposite = 0;
    for (int i = 0; i < 4; ++i) {
      const Vertex v = mesh.corner(exit.tet, i);
      if (v != corners[0] && v != corners[1] && v != corners[2]) opposite = i;
    }
    cavity.tets = {exit.tet, tet_of(mesh.neighbour(exit.tet, opposite))};
  }
  for (const Tet t : cavity.tets)
    for (const Vertex v : corners)
      cavity.faces.push_back(mesh.face_vertices(face_code(t, mesh.index_of(t, v))));
  return cavity;
}

// The parameters t for which A + t (B - A) sees all faces of the cavity form an open interval: each face
// allows one side of the root of a linear function.
class Slide {
 public:
  Slide(const TetMesh& mesh, Vertex a, Vertex b) : a_(mesh.exact_position(a)), b_(mesh.exact_position(b)) {}

  [[nodiscard]] ExactPoint at(const Dyadic& t) const {
    ExactPoint p;
    for (std::size_t k = 0; k < 3; ++k) p.c[k] = a_.c[k] + t * (b_.c[k] - a_.c[k]);
    return p;
  }

  // The shortest dyadic parameter in the middle half of the interval.
  [[nodiscard]] Dyadic find(const TetMesh& mesh, const Cavity& cavity) const {
    struct Linear {
      Dyadic at_a, at_b;
    };
    std::vector<Linear> functions;
    for (const auto& f : cavity.faces) {
      const std::array<ExactPoint, 3> p{mesh.exact_position(f[0]), mesh.exact_position(f[1]),
                                        mesh.exact_position(f[2])};
      functions.push_back(
          {exact::determinant(p[0], p[1], p[2], a_), exact::determinant(p[0], p[1], p[2], b_)});
    }
    for (int bits = 53;; bits *= 2) {
      Dyadic low = 0.0;
      Dyadic high = 1.0;
      for (const Linear& f : functions) {
        const Dyadic rise = f.at_b - f.at_a;
        if (rise.sign() == 0) continue;
        const Dyadic root = exact::quotient(-f.at_a, rise, bits);
        if (rise.sign() > 0 ? root > low : root < high) (rise.sign() > 0 ? low : high) = root;
      }
      if (low >= high) continue;  // the interval is narrower than the error of the roots
      const Dyadic quarter = (high - low).scaled(-2);
      Dyadic t = exact::shortest_between(low + quarter, high - quarter);
      const Dyadic rest = Dyadic(1.0) - t;
      bool inside = true;
      for (const Linear& f : functions) inside = inside && (rest * f.at_a + t * f.at_b).sign() > 0;
      if (inside) return t;
    }
  }

 private:
  ExactPoint a_, b_;
};

void mark_chain_edge(TetMesh& mesh, Vertex a, Vertex b) {
  const Tet t = find_edge(mesh, a, b);
  if (t == kNone) throw std::logic_error("holdfast: a chain edge is missing");
  MeshEditor(mesh).set_segment(t, a, b);
}

enum class Mark { none, segment };

std::vector<Vertex> walk(TetMesh& mesh, Vertex a, Vertex b, Vertex first_free, Mark mark) {
  const Slide slide(mesh, a, b);
  std::vector<Vertex> chain{a};
  std::vector<TetMesh::Corners> fresh;
  while (chain.back() != b) {
    const Vertex from = chain.back();
    const Exit exit = find_exit(mesh, from, b);
    if (exit.count == 1) {
      const Vertex v = exit.corners[0];
      if (v != b && v < first_free) throw std::logic_error("holdfast: an input vertex lies inside a segment");
      if (mark == Mark::segment) mark_chain_edge(mesh, from, v);
      chain.push_back(v);
      continue;
    }
    const Cavity cavity = cavity_of(mesh, exit);
    const Vertex p = MeshEditor(mesh).add_vertex(slide.at(slide.find(mesh, cavity)));
    fresh.clear();
    for (const auto& f : cavity.faces) fresh.push_back({f[0], f[1], f[2], p});
    const std::array<std::array<Vertex, 2>, 1> edge{{{from, p}}};
    const auto segments = std::span(edge).first(mark == Mark::segment ? 1 : 0);
    MeshEditor(mesh).replace({.old_tets = cavity.tets, .new_tets = fresh, .segments = segments});
    chain.push_back(p);
  }
  return chain;
}

}  // namespace

std::vector<Vertex> partition_segment(TetMesh& mesh, Vertex a, Vertex b, Vertex first_free) {
  return walk(mesh, a, b, first_free, Mark::segment);
}

std::vector<Vertex> partition_line(TetMesh& mesh, Vertex a, Vertex b) {
  return walk(mesh, a, b, 0, Mark::none);
}

}  // namespace holdfast
