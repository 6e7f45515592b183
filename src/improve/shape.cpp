#include "improve/shape.h"

#include <cmath>

#include "mesh/quality.h"

namespace holdfast {
namespace {

double distance(const Point& a, const Point& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return std::sqrt(x * x + y * y + z * z);
}

template <typename Act>
void for_each_inside(const TetMesh& mesh, const std::vector<RegionId>& region_of,
                     const std::vector<bool>& kept, Act&& act) {
  for (Tet t = 0; t < mesh.slot_count(); ++t)
    if (mesh.alive(t) && !mesh.is_ghost(t) && kept[region_of[t]]) act(mesh.corners(t));
}

}  // namespace

Report::Shape shape_of(const TetMesh& mesh, const std::vector<RegionId>& region_of,
                       const std::vector<bool>& kept) {
  ShapeHistogram shapes;
  for_each_inside(mesh, region_of, kept, [&](const TetMesh::Corners& c) {
    shapes.add(mesh.position(c[0]), mesh.position(c[1]), mesh.position(c[2]), mesh.position(c[3]));
  });
  return shapes.shape();
}

std::array<std::size_t, 24> edge_lengths_of(const TetMesh& mesh, const std::vector<RegionId>& region_of,
                                            const std::vector<bool>& kept, const std::vector<double>& sizes) {
  constexpr double kBinsAUnit = 8;
  std::array<std::size_t, 24> histogram{};
  for_each_inside(mesh, region_of, kept, [&](const TetMesh::Corners& c) {
    for (const auto& [i, j] : kEdgeVertex) {
      const Vertex v = c[static_cast<std::size_t>(i)], w = c[static_cast<std::size_t>(j)];
      const double bin =
          distance(mesh.position(v), mesh.position(w)) / (0.5 * (sizes[v] + sizes[w])) * kBinsAUnit;
      ++histogram[bin < static_cast<double>(histogram.size()) ? static_cast<std::size_t>(bin)
                                                              : histogram.size() - 1];
    }
  });
  return histogram;
}

}  // namespace holdfast
