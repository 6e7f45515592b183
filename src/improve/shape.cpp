#include "improve/shape.h"

#include <cmath>
#include <mutex>

#include "mesh/parallel.h"
#include "mesh/quality.h"

namespace holdfast {
namespace {

double distance(const Point& a, const Point& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return std::sqrt(x * x + y * y + z * z);
}

// Calls act(corners, own) for each, with one `own` a range of them, and join(own) for each of these at the
// end.
template <typename Own, typename Act, typename Join>
void for_each_inside(const TetMesh& mesh, const std::vector<RegionId>& region_of,
                     const std::vector<bool>& kept, unsigned threads, Act&& act, Join&& join) {
  std::mutex mutex;
  parallel_ranges(threads, mesh.slot_count(), [&](std::size_t first, std::size_t last) {
    Own own{};
    for (auto t = static_cast<Tet>(first); t < last; ++t)
      if (mesh.alive(t) && !mesh.is_ghost(t) && kept[region_of[t]]) act(mesh.corners(t), own);
    const std::scoped_lock lock(mutex);
    join(own);
  });
}

ShapeHistogram shapes_of(const TetMesh& mesh, const std::vector<RegionId>& region_of,
                         const std::vector<bool>& kept, unsigned threads) {
  ShapeHistogram shapes;
  for_each_inside<ShapeHistogram>(
      mesh, region_of, kept, threads,
      [&](const TetMesh::Corners& c, ShapeHistogram& own) {
        own.add(mesh.position(c[0]), mesh.position(c[1]), mesh.position(c[2]), mesh.position(c[3]));
      },
      [&](const ShapeHistogram& own) { shapes.add(own); });
  return shapes;
}

}  // namespace

bool is_flat(const Point& a, const Point& b, const Point& c, const Point& d) {
  constexpr double kFlat = 30;  // Q
  return energy(a, b, c, d) > kEnergyOfFlat && quality(a, b, c, d) > kFlat;
}

Report::Shape shape_of(const TetMesh& mesh, const std::vector<RegionId>& region_of,
                       const std::vector<bool>& kept, unsigned threads) {
  return shapes_of(mesh, region_of, kept, threads).shape();
}

Report::Shape shape_of(const Parts& parts, unsigned threads) {
  std::vector<ShapeHistogram> own(parts.parts().size());
  parallel(threads, own.size(), [&](std::size_t k) {
    const Part& part = parts.parts()[k];
    own[k] = shapes_of(part.mesh, part.region_of, parts.whole().kept, 1);
  });
  ShapeHistogram shapes;
  for (const ShapeHistogram& of_part : own) shapes.add(of_part);
  return shapes.shape();
}

std::array<std::size_t, 24> edge_lengths_of(const TetMesh& mesh, const std::vector<RegionId>& region_of,
                                            const std::vector<bool>& kept, const std::vector<double>& sizes,
                                            unsigned threads) {
  constexpr double kBinsAUnit = 8;
  using Histogram = std::array<std::size_t, 24>;
  Histogram histogram{};
  for_each_inside<Histogram>(
      mesh, region_of, kept, threads,
      [&](const TetMesh::Corners& c, Histogram& own) {
        for (const auto& [i, j] : kEdgeVertex) {
          const Vertex v = c[static_cast<std::size_t>(i)], w = c[static_cast<std::size_t>(j)];
          const double bin =
              distance(mesh.position(v), mesh.position(w)) / (0.5 * (sizes[v] + sizes[w])) * kBinsAUnit;
          ++own[bin < static_cast<double>(own.size()) ? static_cast<std::size_t>(bin) : own.size() - 1];
        }
      },
      [&](const Histogram& own) {
        for (std::size_t k = 0; k < own.size(); ++k) histogram[k] += own[k];
      });
  return histogram;
}

}  // namespace holdfast
