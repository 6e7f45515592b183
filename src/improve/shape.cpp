#include "improve/shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/quality.h"

namespace holdfast {
namespace {

using Vector = std::array<double, 3>;

Vector minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector unit_normal(const Vector& u, const Vector& v) {
  Vector n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const double length = std::sqrt(dot(n, n));
  for (double& x : n) x = length > 0 ? x / length : 0;
  return n;
}
double degrees(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi; }

// Cosines of the least and the largest dihedral angle.
struct Cosines {
  double of_least = -1, of_most = 1;
};
Cosines cosines(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Vector ab = minus(b, a), ac = minus(c, a), ad = minus(d, a), bc = minus(c, b), bd = minus(d, b);
  const std::array<Vector, 4> n{unit_normal(bd, bc), unit_normal(ac, ad), unit_normal(ad, ab),
                                unit_normal(ab, ac)};
  Cosines found;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) {
      const double cosine = -dot(n[i], n[j]);
      found.of_least = std::max(found.of_least, cosine);
      found.of_most = std::min(found.of_most, cosine);
    }
  return found;
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
  constexpr double kBin = 5;
  Report::Shape shape;
  Cosines worst;
  for_each_inside(mesh, region_of, kept, [&](const TetMesh::Corners& c) {
    const Point &p0 = mesh.position(c[0]), &p1 = mesh.position(c[1]), &p2 = mesh.position(c[2]),
                &p3 = mesh.position(c[3]);
    const Cosines found = cosines(p0, p1, p2, p3);
    worst.of_least = std::max(worst.of_least, found.of_least);
    worst.of_most = std::min(worst.of_most, found.of_most);
    const auto bin = static_cast<std::size_t>(degrees(found.of_least) / kBin);
    ++shape.least_dihedral[std::min(bin, shape.least_dihedral.size() - 1)];
    const auto& ends = Report::quality_bins;
    const auto end = std::upper_bound(ends.begin(), ends.end(), quality(p0, p1, p2, p3));
    ++shape.quality[static_cast<std::size_t>(end - ends.begin())];
  });
  if (worst.of_least >= worst.of_most) {
    shape.min_dihedral_deg = degrees(worst.of_least);
    shape.max_dihedral_deg = degrees(worst.of_most);
  }
  return shape;
}

std::array<std::size_t, 24> edge_lengths_of(const TetMesh& mesh, const std::vector<RegionId>& region_of,
                                            const std::vector<bool>& kept, const std::vector<double>& sizes) {
  constexpr double kBinsAUnit = 8;
  std::array<std::size_t, 24> histogram{};
  for_each_inside(mesh, region_of, kept, [&](const TetMesh::Corners& c) {
    for (const auto& [i, j] : kEdgeVertex) {
      const Vertex v = c[static_cast<std::size_t>(i)], w = c[static_cast<std::size_t>(j)];
      const Vector e = minus(mesh.position(v), mesh.position(w));
      const double bin = std::sqrt(dot(e, e)) / (0.5 * (sizes[v] + sizes[w])) * kBinsAUnit;
      ++histogram[bin < static_cast<double>(histogram.size()) ? static_cast<std::size_t>(bin)
                                                              : histogram.size() - 1];
    }
  });
  return histogram;
}

}  // namespace holdfast
