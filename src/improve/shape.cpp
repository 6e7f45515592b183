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
double degrees(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi; }

// Cosines of the least and the largest dihedral angle, and Q.
struct Measured {
  double of_least = -1, of_most = 1, quality = 0;
};
Measured measured(const Point& a, const Point& b, const Point& c, const Point& d) {
  Measured found;
  if (const auto plain = plain_shape(a, b, c, d)) {
    found.quality = plain->quality;
    for (const double cosine : plain->cosines) {
      found.of_least = std::max(found.of_least, cosine);
      found.of_most = std::min(found.of_most, cosine);
    }
    return found;
  }
  found.quality = quality(a, b, c, d);
  for (const double angle : dihedral_angles(a, b, c, d)) {
    const double cosine = std::isnan(angle) ? 1 : std::cos(angle * std::numbers::pi / 180);
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
  std::array<double, 14> cosine_of_end{};  // of each bin but the last
  for (std::size_t k = 0; k < cosine_of_end.size(); ++k)
    cosine_of_end[k] = std::cos(kBin * static_cast<double>(k + 1) * std::numbers::pi / 180);
  Measured worst;
  for_each_inside(mesh, region_of, kept, [&](const TetMesh::Corners& c) {
    const Point &p0 = mesh.position(c[0]), &p1 = mesh.position(c[1]), &p2 = mesh.position(c[2]),
                &p3 = mesh.position(c[3]);
    const Measured found = measured(p0, p1, p2, p3);
    worst.of_least = std::max(worst.of_least, found.of_least);
    worst.of_most = std::min(worst.of_most, found.of_most);
    std::size_t bin = 0;
    while (bin < cosine_of_end.size() && found.of_least <= cosine_of_end[bin]) ++bin;
    ++shape.least_dihedral[bin];
    std::size_t q = 0;
    while (q < Report::quality_bins.size() && !(found.quality < Report::quality_bins[q])) ++q;
    ++shape.quality[q];
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
