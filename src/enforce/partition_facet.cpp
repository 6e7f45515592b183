#include "enforce/partition_facet.h"

#include <stdexcept>

#include "enforce/tuning.h"
#include "exact/rounding.h"
#include "exact/volume.h"
#include "mesh/editor.h"
#include "mesh/kernel.h"
#include "mesh/traverse.h"

namespace holdfast {
namespace {

using exact::Dyadic;
using exact::ExactPoint;

// Points of the facet's plane by their barycentric coordinates.
class Plane {
 public:
  Plane(const TetMesh& mesh, const std::array<Vertex, 3>& corners)
      : a_(mesh.exact_position(corners[0])),
        b_(mesh.exact_position(corners[1])),
        c_(mesh.exact_position(corners[2])) {}

  // The point where the line pq meets the plane. Its barycentric coordinates are the ratios of the volumes
  // that the line spans with the sides; all have one sign, because the line passes inside the facet.
  struct Crossing {
    Dyadic at_b, at_c, sum;
  };
  [[nodiscard]] Crossing crossing(const ExactPoint& p, const ExactPoint& q) const {
    const Dyadic at_a = exact::determinant(p, q, b_, c_);
    Dyadic at_b = exact::determinant(p, q, c_, a_);
    Dyadic at_c = exact::determinant(p, q, a_, b_);
    Dyadic sum = at_a + at_b + at_c;
    return {std::move(at_b), std::move(at_c), std::move(sum)};
  }

  // The point of the plane with the crossing's coordinates, rounded to multiples of 2^-bits.
  [[nodiscard]] ExactPoint near(const Crossing& x, int bits) const {
    const Dyadic u = exact::rounded_to(exact::quotient(x.at_b, x.sum, bits + 2), -bits);
    const Dyadic v = exact::rounded_to(exact::quotient(x.at_c, x.sum, bits + 2), -bits);
    ExactPoint p;
    for (std::size_t k = 0; k < 3; ++k) p.c[k] = a_.c[k] + u * (b_.c[k] - a_.c[k]) + v * (c_.c[k] - a_.c[k]);
    return p;
  }

 private:
  ExactPoint a_, b_, c_;
};

void split_edge(TetMesh& mesh, const Plane& plane, Vertex above, Vertex below) {
  const Tet first = find_edge(mesh, above, below);
  if (first == kNone) throw std::logic_error("holdfast: a piercing edge vanished");
  std::vector<Tet> ring;
  shell(mesh, first, above, below, ring);
  Kernel kernel(mesh);
  for (const Tet t : ring)
    for (const Vertex v : {above, below}) {
      const auto f = mesh.face_vertices(face_code(t, mesh.index_of(t, v)));
      kernel.add(f[0], f[1], f[2]);
    }
  const Plane::Crossing crossing = plane.crossing(mesh.exact_position(above), mesh.exact_position(below));
  for (int bits = tuning::kFirstBits;; bits *= 2) {
    const Vertex p = MeshEditor(mesh).add_vertex(plane.near(crossing, bits));
    if (!kernel.holds(mesh.point(p))) {
      MeshEditor(mesh).remove_last_vertex();
      continue;
    }
    std::vector<TetMesh::Corners> fresh;
    for (const auto& f : kernel.faces()) fresh.push_back({f[0], f[1], f[2], p});
    MeshEditor(mesh).replace({.old_tets = ring, .new_tets = fresh});
    return;
  }
}

}  // namespace

FacetPieces partition_facet(TetMesh& mesh, const FacetFrame& frame) {
  FacetPieces pieces;
  FacetSection section = facet_section(mesh, frame);
  if (!section.stands()) {
    const Plane plane(mesh, frame.corners);
    for (const auto& e : section.piercing) split_edge(mesh, plane, e.above, e.below);
    pieces.added = section.piercing.size();
    section = facet_section(mesh, frame);
    if (!section.stands()) throw std::logic_error("holdfast: a facet is pierced after its partition");
  }
  for (const Face f : section.faces) {
    MeshEditor(mesh).set_facet(f);
    pieces.faces.push_back(mesh.face_vertices(f));
  }
  pieces.inner = std::move(section.inner);
  return pieces;
}

}  // namespace holdfast
