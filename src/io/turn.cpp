#include "io/turn.h"

#include <algorithm>
#include <array>
#include <utility>

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

}  // namespace

bool is_turned(const Tetrahedron& t, const std::vector<Point>& vertices) {
  return volume_in_plain_arithmetic(t, vertices) < 0;
}

void turn_if_all_are_turned(MeshData& mesh, const std::string& remark) {
  std::vector<Tetrahedron>& all = mesh.tetrahedra;
  if (all.empty() ||
      !std::all_of(all.begin(), all.end(), [&](const Tetrahedron& t) { return is_turned(t, mesh.vertices); }))
    return;
  for (Tetrahedron& t : all) std::swap(t[1], t[2]);
  for (auto& nodes : mesh.mids.tetrahedra) {  // of the edges 01 12 02 03 13 23
    std::swap(nodes[0], nodes[2]);
    std::swap(nodes[4], nodes[5]);
  }
  mesh.remarks.push_back({RemarkKind::left_out, all.size(), remark});
}

void turn_to_vtk(MeshData& mesh) {
  turn_if_all_are_turned(mesh, "all tetrahedra are oriented opposite to VTK's, and are reversed");
}

}  // namespace holdfast::io
