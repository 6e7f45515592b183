// A mesh without points inside has tetrahedra from side to side, and the cavities of points are as large. A
// cavity reaches across a plane only as far as empty spheres that contain the point and meet the plane. So
// the circles in which spheres meet the planes are made small by points in their middles, as in Delaunay
// refinement in the plane (Chew 1989).
#include "refine/section_points.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>

#include "mesh/measure.h"
#include "numbers/vector.h"
#include "refine/circumcentre.h"
#include "refine/field_inserter.h"
#include "refine/tets_inside.h"
#include "refine/tuning.h"

namespace holdfast {
namespace {

// The middle of the points where edges cross the plane.
Point middle_of_section(const std::array<Point, 4>& corners, const Cuts::Plane& plane) {
  Point sum{};
  double count = 0;
  for (const auto& [i, j] : kEdgeVertex) {
    const Point &a = corners[static_cast<std::size_t>(i)], &b = corners[static_cast<std::size_t>(j)];
    const double from = a[plane.axis] - plane.at, to = b[plane.axis] - plane.at;
    if ((from < 0) == (to < 0)) continue;
    for (std::size_t k = 0; k < 3; ++k) sum[k] += a[k] + from / (from - to) * (b[k] - a[k]);
    count += 1;
  }
  for (double& x : sum) x /= count;
  sum[plane.axis] = plane.at;
  return sum;
}

class SectionRefiner {
 public:
  SectionRefiner(const VolumeData& volume, const Cuts& cuts, const SizeFunction& sizes, Monitor& monitor)
      : volume_(volume),
        mesh_(volume.mesh),
        cuts_(cuts),
        sizes_(sizes),
        monitor_(monitor),
        inserter_(volume, sizes, monitor) {}

  void run(const Threads& threads) {
    const std::vector<Tet> large =
        tets_inside(volume_, threads, [&](Tet t) { return large_circle(t).has_value(); });
    large_.assign(large.begin(), large.end());
    // The list has dead tetrahedra and slots that were filled again; their present tetrahedra are examined.
    while (!large_.empty() && !inserter_.has_wasted_enough()) {
      const Tet t = large_.front();
      large_.pop_front();
      monitor_.poll(Stage::field_points, 0);
      const auto circle = large_circle(t);
      if (!circle) continue;
      look_at(put_point_into(*circle, t), threads);
    }
  }

  [[nodiscard]] double share_of_huge(const Threads& threads) const {
    const std::vector<Tet> across = tets_inside(volume_, threads, [&](Tet t) {
      return cuts_.any_across(corners_of(t), [](const Cuts::Plane&) { return true; });
    });
    double huge = 0, all = 0;
    for (const Tet t : across) {
      const double volume = six_volumes(mesh_, mesh_.corners(t));
      all += volume;
      if (const auto circle = large_circle(t); circle && circle->is_huge) huge += volume;
    }
    return all > 0 ? huge / all : 0;
  }

 private:
  // The circle in which the sphere of a tetrahedron meets a plane.
  struct Circle {
    Point middle;
    Point in_tet;   // in the middle of where the tetrahedron meets the plane
    Point towards;  // one size from the middle towards the sphere's centre
    bool is_of_a_cap, is_huge;
  };

  // Where the sphere meets the plane in a small cap, a vertex beyond the plane may be too close to the
  // circle's middle; then a point farther inside the sphere is used. Near facets much larger than the size,
  // the middle may be beyond the facets.
  std::span<const Tet> put_point_into(const Circle& circle, Tet t) {
    auto created = inserter_.insert(circle.middle, t);
    if (created.empty() && circle.is_of_a_cap) created = inserter_.insert(circle.towards, t);
    if (created.empty() && circle.is_huge) created = inserter_.insert(circle.in_tet, t);
    return created;
  }

  // The first points of a section are joined to the surface from side to side.
  void look_at(std::span<const Tet> fresh, const Threads& threads) {
    is_large_.resize(fresh.size());
    parallel_ranges(threads, fresh.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) is_large_[k] = large_circle(fresh[k]) ? 1 : 0;
    });
    for (std::size_t k = 0; k < fresh.size(); ++k)
      if (is_large_[k] != 0) large_.push_back(fresh[k]);
  }

  [[nodiscard]] std::optional<Circle> large_circle(Tet t) const {
    if (!volume_.is_inside(t)) return {};
    const std::array<Point, 4> corners = corners_of(t);
    std::optional<Circle> found;
    cuts_.any_across(corners, [&](const Cuts::Plane& plane) {
      const ScaledCentre scaled = sphere_centre(corners[0], corners[1], corners[2], corners[3]);
      Point centre;
      for (std::size_t k = 0; k < 3; ++k) centre[k] = corners[0][k] + scaled.at[k] / scaled.scale;
      Point middle = centre;
      middle[plane.axis] = plane.at;
      const double size = size_at(middle, t), height = centre[plane.axis] - plane.at;
      const double to_corner = distance(centre, corners[0]);
      const double radius2 = to_corner * to_corner - height * height;
      if (!(radius2 > tuning::kLargestOnCut * tuning::kLargestOnCut * size * size)) return false;
      Point towards = centre;
      towards[plane.axis] = plane.at + std::copysign(size, height);
      found = {middle, middle_of_section(corners, plane), towards, std::abs(height) > size,
               radius2 > tuning::kHugeOnCut * tuning::kHugeOnCut * size * size};
      return true;
    });
    return found;
  }

  [[nodiscard]] std::array<Point, 4> corners_of(Tet t) const {
    std::array<Point, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = mesh_.position(mesh_.corners(t)[i]);
    return corners;
  }

  [[nodiscard]] double size_at(const Point& p, Tet t) const {
    double size = sizes_.limit(p, volume_.region_of[t]);
    for (const Vertex v : mesh_.corners(t))
      size = std::min(size, volume_.sizes[v] + sizes_.gradation() * distance(p, mesh_.position(v)));
    return size;
  }

  const VolumeData volume_;
  const TetMesh& mesh_;
  const Cuts& cuts_;
  const SizeFunction& sizes_;
  Monitor& monitor_;
  FieldInserter inserter_;
  std::deque<Tet> large_;
  std::vector<char> is_large_;  // for the newest tetrahedra
};

}  // namespace

double add_section_points(const VolumeData& volume, const Cuts& cuts, const SizeFunction& sizes,
                          const Threads& threads, Monitor& monitor) {
  SectionRefiner refiner(volume, cuts, sizes, monitor);
  refiner.run(sizes.threads_of(threads));
  return refiner.share_of_huge(threads);
}

}  // namespace holdfast
