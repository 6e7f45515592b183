#include "io/cells.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <stdexcept>
#include <utility>

#include "io/mid_nodes.h"
#include "io/turn.h"

namespace holdfast::io {
namespace {

using Faces = std::initializer_list<std::initializer_list<std::size_t>>;

// In the order of sides in Abaqus and CalculiX, from S1.
constexpr Faces kHexahedron{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                            {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
constexpr Faces kPrism{{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
constexpr Faces kPyramid{{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};

Faces faces_of(std::size_t corners) {
  switch (corners) {
    case 8:
      return kHexahedron;
    case 6:
      return kPrism;
    case 5:
      return kPyramid;
    default:
      throw std::logic_error("a cell of neither 5, 6 nor 8 corners");
  }
}

std::size_t& count_of(MeshData::Cells& cells, std::size_t corners) {
  return corners == 8 ? cells.hexahedra : corners == 6 ? cells.prisms : cells.pyramids;
}

// The corners of a face without repeated ones.
struct Ring {
  std::array<Index, 4> corners;
  std::size_t count = 0;

  Ring(std::span<const Index> nodes, std::initializer_list<std::size_t> face) {
    for (const std::size_t k : face)
      if (!holds(nodes[k])) corners[count++] = nodes[k];
  }
  [[nodiscard]] bool holds(Index v) const {
    return std::find(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(count), v) !=
           corners.begin() + static_cast<std::ptrdiff_t>(count);
  }
  [[nodiscard]] std::size_t lowest() const {
    return static_cast<std::size_t>(
        std::min_element(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(count)) -
        corners.begin());
  }
};

// Calls `use` for the triangles of a ring, as a fan from its lowest vertex.
template <typename Use>
void for_each_triangle(const Ring& ring, const Use& use) {
  if (ring.count < 3) return;
  const std::size_t first = ring.lowest();
  const auto at = [&](std::size_t k) { return ring.corners[(first + k) % ring.count]; };
  for (std::size_t k = 2; k < ring.count; ++k) use(Triangle{at(0), at(k - 1), at(k)});
}

bool holds(const Triangle& t, Index v) { return t[0] == v || t[1] == v || t[2] == v; }

}  // namespace

void add_cell(MeshData& mesh, std::span<const Index> nodes, std::size_t corners, int region) {
  const Faces faces = faces_of(corners);
  ++count_of(mesh.cells, corners);
  add_no_corners(mesh, nodes.subspan(corners));
  const Index apex = *std::min_element(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(corners));
  for (const auto& face : faces) {
    const Ring ring(nodes, face);
    if (ring.holds(apex)) continue;
    for_each_triangle(ring, [&](const Triangle& triangle) {
      Tetrahedron tet{apex, triangle[0], triangle[1], triangle[2]};
      if (is_turned(tet, mesh.vertices)) std::swap(tet[2], tet[3]);
      mesh.add_tetrahedron(tet, region);
      ++mesh.cells.tetrahedra;
    });
  }
}

std::vector<Triangle> side_of_cell(std::span<const Index> corners, std::size_t side) {
  const Faces faces = faces_of(corners.size());
  std::vector<Triangle> triangles;
  if (side < faces.size())
    for_each_triangle(Ring(corners, faces.begin()[side]),
                      [&](const Triangle& triangle) { triangles.push_back(triangle); });
  return triangles;
}

std::optional<Tetrahedron> degenerate_tetrahedron(std::span<const Index> hexahedron) {
  const auto& n = hexahedron;
  if (n[4] != n[5] || n[5] != n[6] || n[6] != n[7] || (n[3] != n[2] && n[3] != n[4])) return std::nullopt;
  const Tetrahedron corners{n[0], n[1], n[2], n[4]};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (corners[i] == corners[k]) return std::nullopt;
  return corners;
}

std::vector<Triangle> triangles_of_side(std::span<const Index> corners) {
  if (corners.size() == 3) return {{corners[0], corners[1], corners[2]}};
  std::vector<Triangle> triangles;
  for_each_triangle(Ring(corners, {0, 1, 2, 3}),
                    [&](const Triangle& triangle) { triangles.push_back(triangle); });
  return triangles;
}

void settle_quadrangles(MeshData& mesh) {
  if (mesh.cells.tetrahedra == 0) return;
  for (const Index first : mesh.quadrangles) {
    Triangle &one = mesh.facets[first], &other = mesh.facets[first + 1];
    std::size_t i = 0, j = 0;  // indices of the corners not on the diagonal
    while (i < 3 && holds(other, one[i])) ++i;
    while (j < 3 && holds(one, other[j])) ++j;
    if (i == 3 || j == 3) continue;
    const Index p = one[i], q = other[j], a = one[(i + 1) % 3], b = one[(i + 2) % 3];
    if (std::min(a, b) < std::min(p, q)) continue;
    one = {p, a, q};
    other = {q, b, p};
  }
}

std::string words_of(const MeshData::Cells& cells) {
  std::vector<std::string> all;
  const auto add = [&](std::size_t count, const char* one, const char* several) {
    if (count > 0) all.push_back(std::to_string(count) + ' ' + (count == 1 ? one : several));
  };
  add(cells.hexahedra, "hexahedron", "hexahedra");
  add(cells.prisms, "prism", "prisms");
  add(cells.pyramids, "pyramid", "pyramids");
  std::string words;
  for (std::size_t i = 0; i < all.size(); ++i)
    words += (i == 0 ? "" : i + 1 == all.size() ? " and " : ", ") + all[i];
  return words;
}

}  // namespace holdfast::io
