#include "io/fluent_cells.h"

#include <algorithm>

namespace holdfast::io {
namespace {

bool has(std::span<const Index> corners, Index vertex) {
  return std::find(corners.begin(), corners.end(), vertex) != corners.end();
}

/// The face that the corners begin with; nothing for a polyhedron of other faces.
const FaceOfCell* base_of(std::span<const FaceOfCell> faces) {
  std::size_t triangles = 0, quadrangles = 0;
  for (const FaceOfCell& face : faces) {
    triangles += face.count == 3 ? 1 : 0;
    quadrangles += face.count == 4 ? 1 : 0;
  }
  if (triangles + quadrangles != faces.size()) return nullptr;
  const bool is_tetrahedron = triangles == 4 && quadrangles == 0,
             is_pyramid = triangles == 4 && quadrangles == 1, is_prism = triangles == 2 && quadrangles == 3,
             is_hexahedron = triangles == 0 && quadrangles == 6;
  if (!is_tetrahedron && !is_pyramid && !is_prism && !is_hexahedron) return nullptr;
  const std::size_t corners = is_tetrahedron || is_prism ? 3 : 4;
  return &*std::find_if(faces.begin(), faces.end(),
                        [&](const FaceOfCell& face) { return face.count == corners; });
}

/// The vertex outside the base at the other end of the edges from one of its corners; nothing if there are
/// several, or none.
std::optional<Index> above(std::span<const FaceOfCell> faces, std::span<const Index> base, Index corner) {
  std::optional<Index> found;
  for (const FaceOfCell& face : faces)
    for (std::size_t k = 0; k < face.count; ++k) {
      const Index a = face.of[k], b = face.of[(k + 1) % face.count];
      if (a != corner && b != corner) continue;
      const Index other = a == corner ? b : a;
      if (has(base, other)) continue;
      if (found && *found != other) return std::nullopt;
      found = other;
    }
  return found;
}

/// Whether the faces have these corners alone, three faces at each, or four at the apex of a pyramid.
bool fits(std::span<const FaceOfCell> faces, std::span<const Index> corners) {
  std::array<std::size_t, 8> faces_at{};
  for (const FaceOfCell& face : faces)
    for (const Index v : face.corners()) {
      if (!has(corners, v)) return false;
      ++faces_at[static_cast<std::size_t>(std::find(corners.begin(), corners.end(), v) - corners.begin())];
    }
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (faces_at[i] != (corners.size() == 5 && i == 4 ? 4 : 3)) return false;
  return true;
}

}  // namespace

std::optional<CornersOfCell> corners_of_cell(std::span<const FaceOfCell> faces) {
  const FaceOfCell* const base = base_of(faces);
  if (base == nullptr) return std::nullopt;
  const bool has_apex = faces.size() == base->count + 1;
  CornersOfCell cell;
  for (const Index v : base->corners()) {
    if (has(cell.corners(), v)) return std::nullopt;
    cell.of[cell.count++] = v;
  }
  for (const Index v : base->corners()) {
    const std::optional<Index> top = above(faces, base->corners(), v);
    if (!top) return std::nullopt;
    const bool is_known = has(cell.corners(), *top);
    const bool is_first = cell.count == base->count;
    if (is_known != (has_apex && !is_first)) return std::nullopt;
    if (!is_known) cell.of[cell.count++] = *top;
  }
  if (!fits(faces, cell.corners())) return std::nullopt;
  return cell;
}

}  // namespace holdfast::io
