#include "optimise/shape.h"

#include <mutex>

#include "mesh/parallel.h"
#include "mesh/quality.h"

namespace holdfast {
namespace {

// Calls act(corners, own) for each tetrahedron, with one `own` for each range, and join(own) for each range
// at the end.
template <typename Own, typename Act, typename Join>
void for_each_inside(const VolumeData& volume, const Threads& threads, Act&& act, Join&& join) {
  std::mutex mutex;
  parallel_ranges(threads, volume.mesh.slot_count(), [&](std::size_t first, std::size_t last) {
    Own own{};
    for (auto t = static_cast<Tet>(first); t < last; ++t)
      if (volume.is_inside(t)) act(volume.mesh.corners(t), own);
    const std::scoped_lock lock(mutex);
    join(own);
  });
}

ShapeHistogram shapes_of(const VolumeData& volume, const Threads& threads) {
  ShapeHistogram shapes;
  for_each_inside<ShapeHistogram>(
      volume, threads,
      [&](const TetMesh::Corners& c, ShapeHistogram& own) {
        volume.see(
            c, [&](const Point& p, const Point& q, const Point& r, const Point& s) { own.add(p, q, r, s); });
      },
      [&](const ShapeHistogram& own) { shapes.add(own); });
  return shapes;
}

}  // namespace

bool is_flat(const Point& a, const Point& b, const Point& c, const Point& d) {
  return energy(a, b, c, d) > kEnergyOfFlat && quality(a, b, c, d) > tuning::kBad;
}

ShapeCounts shape_of(const VolumeData& volume, const Threads& threads) {
  return shapes_of(volume, threads).counts();
}

ShapeCounts shape_of(Parts& parts, const Threads& threads) {
  ShapeHistogram shapes;
  for (Part& part : parts.parts()) shapes.add(shapes_of(part.data(parts.whole()), threads));
  return shapes.counts();
}

std::array<std::size_t, 24> edge_lengths_of(const VolumeData& volume, const Threads& threads) {
  constexpr double kBinsAUnit = 8;
  using Histogram = std::array<std::size_t, 24>;
  Histogram histogram{};
  for_each_inside<Histogram>(
      volume, threads,
      [&](const TetMesh::Corners& c, Histogram& own) {
        for (int edge = 0; edge < 6; ++edge) {
          const auto [v, w] = ends_of_edge(c, edge);
          const double bin = volume.length_over_size(v, w) * kBinsAUnit;
          ++own[bin < static_cast<double>(own.size()) ? static_cast<std::size_t>(bin) : own.size() - 1];
        }
      },
      [&](const Histogram& own) {
        for (std::size_t k = 0; k < own.size(); ++k) histogram[k] += own[k];
      });
  return histogram;
}

}  // namespace holdfast
