#include "io/turn.h"

#include <algorithm>
#include <array>
#include <utility>

#include "text/count.h"

namespace holdfast::io {
namespace {

double volume_in_plain_arithmetic(const Tetrahedron& t, const std::vector<Point>& vertices) {
  std::array<Point, 3> e{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) e[i][k] = vertices[t[i + 1]][k] - vertices[t[0]][k];
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
         e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

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
  return volume_in_plain_arithmetic(t, vertices) < 0;
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
