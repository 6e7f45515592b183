#include "io/turn.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "exact/predicates.h"
#include "text/count.h"

namespace holdfast::io {
namespace {

void reverse(MeshData& mesh, Index tetrahedron) {
  std::swap(mesh.tetrahedra[tetrahedron][1], mesh.tetrahedra[tetrahedron][2]);
  if (tetrahedron >= mesh.mids.tetrahedra.size()) return;
  std::array<Index, 6>& nodes = mesh.mids.tetrahedra[tetrahedron];  // of the edges 01 12 02 03 13 23
  std::swap(nodes[0], nodes[2]);
  std::swap(nodes[4], nodes[5]);
}

/// Whether no face has two tetrahedra on the same side, by the order of their corners.
bool fit_at_faces(const std::vector<Tetrahedron>& tetrahedra) {
  // A face with its least corner first is one of two triangles, which differ in the order of the others.
  std::vector<Triangle> faces;
  faces.reserve(4 * tetrahedra.size());
  for (const Tetrahedron& t : tetrahedra)
    for (std::size_t i = 0; i < 4; ++i) {
      Triangle face = outward_face(t, i);
      std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
      faces.push_back(face);
    }
  std::sort(faces.begin(), faces.end());
  return std::adjacent_find(faces.begin(), faces.end()) == faces.end();
}

}  // namespace

bool is_turned(const Tetrahedron& t, const std::vector<Point>& vertices) {
  const auto is_finite = [&](Index v) {
    return std::all_of(vertices[v].begin(), vertices[v].end(), [](double x) { return std::isfinite(x); });
  };
  if (!std::all_of(t.begin(), t.end(), is_finite)) return false;
  return exact::orient3d(vertices[t[0]].data(), vertices[t[1]].data(), vertices[t[2]].data(),
                         vertices[t[3]].data()) < 0;
}

void turn_if_all_are_turned(MeshData& mesh, const std::string& remark) {
  const std::vector<Tetrahedron>& all = mesh.tetrahedra;
  if (all.empty() ||
      !std::all_of(all.begin(), all.end(), [&](const Tetrahedron& t) { return is_turned(t, mesh.vertices); }))
    return;
  for (Index i = 0; i < all.size(); ++i) reverse(mesh, i);
  mesh.remarks.push_back({RemarkKind::left_out, all.size(), remark});
}

void turn_to_vtk(MeshData& mesh) {
  std::vector<Index> turned;
  for (Index i = 0; i < mesh.tetrahedra.size(); ++i)
    if (is_turned(mesh.tetrahedra[i], mesh.vertices)) turned.push_back(i);
  if (turned.empty()) return;
  if (turned.size() == mesh.tetrahedra.size())
    return turn_if_all_are_turned(mesh, "all tetrahedra are oriented opposite to VTK's, and are reversed");
  if (fit_at_faces(mesh.tetrahedra)) return;
  for (const Index i : turned) reverse(mesh, i);
  if (fit_at_faces(mesh.tetrahedra)) {
    mesh.remarks.push_back({RemarkKind::left_out, turned.size(),
                            counted(turned.size(), "tetrahedron is", "tetrahedra are") +
                                " oriented opposite to the others, and reversed"});
    return;
  }
  for (const Index i : turned) reverse(mesh, i);
}

}  // namespace holdfast::io
