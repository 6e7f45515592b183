#include "refine/elements_of_function.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "mesh/measure.h"

namespace holdfast {
namespace {

/// Points are gathered from so many, because functions prefer to be asked about many at once.
constexpr std::size_t kTetsACall = 4096;

// The number of elements of edge 1 in a volume of 1 in a metric, relative to Euclidean space: the root of the
// determinant. Computed from Cholesky's pivots, because the sum of products is pure rounding where sizes
// differ much.
double density(const Metric& m) {
  const auto& [xx, xy, yy, xz, yz, zz] = m;
  const double u = xy / xx, w = xz / xx, second = yy - u * xy, v = (yz - u * xz) / second,
               third = zz - w * xz - v * v * second;
  const bool is_regular = xx > 0 && second > 0 && third > 0;
  return is_regular ? std::sqrt(xx) * std::sqrt(second) * std::sqrt(third) : 0;
}

// Elements per unit of volume, by place.
std::vector<double> densities(const SizeFunction& sizes, std::span<const Point> points,
                              std::span<const RegionId> regions) {
  std::vector<double> found(points.size());
  if (sizes.has_metric()) {
    std::transform(points.begin(), points.end(), found.begin(), [&](const Point& p) {
      return density(sizes.metric(p, std::numeric_limits<double>::infinity()));
    });
  } else {
    sizes.limits(points, regions, found);
    for (double& h : found) h = 1 / h / h / h;
  }
  return found;
}

void add_centre(const VolumeData& volume, Tet t, std::vector<Point>& points) {
  points.push_back(centroid(volume.mesh, t));
}

void add_corners_and_middles(const VolumeData& volume, Tet t, std::vector<Point>& points) {
  const TetMesh::Corners& c = volume.mesh.corners(t);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const Point &p = volume.mesh.position(c[i]), &q = volume.mesh.position(c[j]);
      points.push_back({0.5 * p[0] + 0.5 * q[0], 0.5 * p[1] + 0.5 * q[1], 0.5 * p[2] + 0.5 * q[2]});
    }
}

// The elements in tetrahedra. Each tetrahedron has the least density of the points that `add` gives it.
template <typename Add>
double elements_in(const VolumeData& volume, const SizeFunction& sizes, std::span<const Tet> tets,
                   Add&& add) {
  std::vector<Point> points;
  for (const Tet t : tets) add(volume, t, points);
  const std::size_t each = points.size() / tets.size();
  std::vector<RegionId> regions;
  for (const Tet t : tets) regions.insert(regions.end(), each, volume.region_of[t]);
  const std::vector<double> found = densities(sizes, points, regions);
  double elements = 0;
  for (std::size_t k = 0; k < tets.size(); ++k) {
    const double six = six_volumes(volume.mesh, volume.mesh.corners(tets[k]));
    const double least = *std::min_element(&found[k * each], &found[k * each] + each);
    // Beyond the range of doubles the number is unknown.
    if (std::isfinite(six) && six > 0 && least > 0) elements += std::numbers::sqrt2 * six * least;
  }
  return elements;
}

template <typename Add>
bool exceed(double most, const VolumeData& volume, const SizeFunction& sizes, Add&& add) {
  double elements = 0;
  std::vector<Tet> tets;
  for (Tet t = 0; t < volume.mesh.slot_count(); ++t) {
    if (volume.is_inside(t)) tets.push_back(t);
    if (tets.size() < kTetsACall && t + 1 < volume.mesh.slot_count()) continue;
    if (!tets.empty()) elements += elements_in(volume, sizes, tets, add);
    tets.clear();
  }
  return elements > most;
}

}  // namespace

bool asks_for_more_than(double most, const SizeFunction& sizes, const VolumeData& volume) {
  if (!sizes.has_field() && !sizes.has_metric()) return false;
  // The centres are the fewest points, and nearly always they suffice to show that it does not exceed `most`.
  return exceed(most, volume, sizes, add_centre) &&
         exceed(most, volume, sizes, [](const VolumeData& data, Tet t, std::vector<Point>& points) {
           add_centre(data, t, points);
           add_corners_and_middles(data, t, points);
         });
}

}  // namespace holdfast
