// Bytes as points and segments in the plane, in a file or not: every method gives positive triangles of the
// same area, or names a defect; refinement terminates.
#include "holdfast/plane.h"

#include <stdexcept>
#include <vector>

#include "bytes.h"
#include "exact/dyadic.h"
#include "exact/predicates.h"
#include "holdfast/names.h"

namespace {

using namespace holdfast;
using fuzz::Bytes;

constexpr std::size_t kMostPoints = 40, kMostSegments = 60;

// The raw plane, or one without what makes it invalid.
Plane plane_from(Bytes& bytes) {
  const bool filtered = bytes.byte() % 8 != 0;
  Plane plane;
  const auto keep_if_valid = [&](auto& list) {
    if (filtered && !diagnose(plane, 1).empty()) list.pop_back();
  };
  for (std::size_t n = bytes.byte() % kMostPoints; n > 0; --n) {
    const double x = bytes.coordinate();
    plane.points.push_back({x, bytes.coordinate()});
    keep_if_valid(plane.points);
  }
  for (std::size_t n = bytes.byte() % kMostSegments; n > 0 && bytes.left() > 0; --n) {
    const Index a = bytes.below(plane.points.size() + (filtered ? 0 : 1));
    plane.segments.push_back({a, bytes.below(plane.points.size() + (filtered ? 0 : 1))});
    keep_if_valid(plane.segments);
  }
  for (std::size_t n = bytes.byte() % 3; n > 0; --n)
    plane.holes.push_back({bytes.coordinate(), bytes.coordinate()});
  return plane;
}

Plane plane_of_file(Bytes& bytes) {
  static const fuzz::Folder folder;
  folder.empty();
  folder.write_parts(bytes.text(), std::array{".poly", ".node"});
  return read_plane(folder / "a.poly");
}

exact::Dyadic double_area(const PlaneMesh& mesh) {
  exact::Dyadic sum;
  for (const Triangle& t : mesh.triangles) {
    for (const Index v : t) fuzz::require(v < mesh.points.size(), "a corner out of range");
    const auto at = [&](std::size_t i) { return mesh.points[t[i]].data(); };
    fuzz::require(exact::orient2d(at(0), at(1), at(2)) > 0, "a triangle is not positive");
    const auto difference = [&](std::size_t i, std::size_t k) {
      return exact::Dyadic(at(i)[k]) - exact::Dyadic(at(0)[k]);
    };
    sum += difference(1, 0) * difference(2, 1) - difference(1, 1) * difference(2, 0);
  }
  return sum;
}

void solve(const Plane& plane, bool hull, double angle) {
  std::optional<exact::Dyadic> area;
  for (const PlaneMethod method : values_of<PlaneMethod>()) {
    PlaneOptions options;
    options.method = method;
    options.hull = hull;
    options.delaunay = hull;
    const PlaneResult result = triangulate(plane, options);
    fuzz::require(result.outcome == Outcome::done || !result.defects.empty(), "refused without a defect");
    const exact::Dyadic now = double_area(result.mesh);
    fuzz::require(!area || *area == now, "the methods differ in area");
    area = now;
  }
  PlaneOptions options;
  options.hull = hull;
  options.angle = angle;
  options.max_points = 2000;
  options.keep_boundary = hull;
  static_cast<void>(double_area(triangulate(plane, options).mesh));
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const std::uint8_t how = bytes.byte();
  try {
    const Plane plane = (how & 1u) != 0 ? plane_of_file(bytes) : plane_from(bytes);
    if (plane.points.size() + plane.segments.size() > 300) return 0;
    solve(plane, (how & 2u) != 0, (how >> 2u) % 35);
  } catch (const FileError&) {
  } catch (const std::invalid_argument&) {  // a hole that is not finite
  }
  return 0;
}
