// Check: the boundary of a volume and the cover number beside it. The head of boundary.h gives the proofs.
#include "check/boundary.h"

#include <algorithm>
#include <tuple>

#include "check/disjoint_sets.h"
#include "check/intersect.h"
#include "exact/predicates.h"

namespace holdfast::checking {

using exact::orient3d;

int Germ::side_of_line(const double* u, const double* v) const {
  for (std::size_t i = 0; i < count; ++i)
    if (const int sign = orient_along(0, u, v, points[i]); sign != 0) return i == 3 && away ? -sign : sign;
  if (u[2] != v[2]) return u[2] > v[2] ? 1 : -1;  // a step along y turns left of uv if uv goes down
  if (u[1] != v[1]) return v[1] > u[1] ? 1 : -1;
  return 0;
}

int Germ::side_of_plane(const double* u, const double* v, const double* w) const {
  for (std::size_t i = 0; i < count; ++i)
    if (const int sign = orient3d(u, v, w, points[i]); sign != 0) return i == 3 && away ? -sign : sign;
  return 0;
}

Boundary::Boundary(const FaceTable& faces, std::span<const Tetrahedron> tetrahedra,
                   std::span<const Point> vertices, Pulse& pulse)
    : vertices_(vertices) {
  faces.for_each([&](std::size_t, const Triangle&, std::span<const HalfFace> halves) {
    pulse();
    if (halves.size() != 1) return;
    const Index tetrahedron = halves[0].tetrahedron();
    const unsigned side = halves[0].side();
    faces_.push_back({side_of(tetrahedra[tetrahedron], side), tetrahedra[tetrahedron][side], tetrahedron});
  });
  std::vector<Box> boxes;
  boxes.reserve(faces_.size());
  for (const BoundaryFace& face : faces_) boxes.push_back(box_of(face.corners, vertices));
  tree_ = BoxTree(std::move(boxes));
}

Corners Boundary::corners(Index face) const {
  const Triangle& corner = faces_[face].corners;
  return {at(corner[0]), at(corner[1]), at(corner[2])};
}

std::vector<std::array<Index, 2>> Boundary::crossing_pairs(Pulse& pulse) const {
  std::vector<std::array<Index, 2>> pairs;
  tree_.self_pairs([&](Index x, Index y) {
    pulse();
    if (meet_badly(faces_[x].corners, corners(x), faces_[y].corners, corners(y)))
      pairs.push_back({std::min(x, y), std::max(x, y)});
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<Boundary::Side> Boundary::sorted_sides() const {
  std::vector<Side> sides;
  sides.reserve(3 * faces_.size());
  for (Index face = 0; face < faces_.size(); ++face)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(faces_[face].corners[i], faces_[face].corners[(i + 1) % 3]);
      sides.push_back({low, high, face});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    return std::tie(x.low, x.high, x.face) < std::tie(y.low, y.high, y.face);
  });
  return sides;
}

namespace {

/// Calls `visit(span)` for each run of sides with the same ends.
template <class Side, class Visit>
void for_each_fan(std::vector<Side>& sides, Visit&& visit) {
  for (std::size_t begin = 0; begin < sides.size();) {
    std::size_t end = begin + 1;
    while (end < sides.size() && sides[end].low == sides[begin].low && sides[end].high == sides[begin].high)
      ++end;
    visit(std::span<Side>(sides).subspan(begin, end - begin));
    begin = end;
  }
}

}  // namespace

Germ Boundary::beside(Index face, bool inside) const {
  // A ray along +x from the corner with the largest x meets the fewest faces.
  Corners corner = corners(face);
  std::rotate(corner.begin(),
              std::max_element(corner.begin(), corner.end(), [](auto* x, auto* y) { return x[0] < y[0]; }),
              corner.end());
  return {{corner[0], corner[1], corner[2], at(faces_[face].apex)}, 4, !inside};
}

int Boundary::crossing(Index face, const Germ& germ) const {
  const Corners t = corners(face);
  const int outward = orient_along(0, t[0], t[1], t[2]);  // sign of the outward normal's x
  if (outward == 0) return 0;                             // parallel to the ray, which is generic
  for (std::size_t i = 0; i < 3; ++i)
    if (germ.side_of_line(t[i], t[(i + 1) % 3]) != outward) return 0;
  return germ.side_of_plane(t[0], t[1], t[2]) == -outward ? outward : 0;  // else the plane is behind
}

int Boundary::cross(const Germ& germ) const {
  const Point origin{germ.points[0][0], germ.points[0][1], germ.points[0][2]};
  int sum = 0;
  tree_.query([&](const Box& box) { return box.meets_ray(origin); },
              [&](Index face) { sum += crossing(face, germ); });
  return sum;
}

double Boundary::reach(Index face) const {
  const Corners t = corners(face);
  return std::max({t[0][0], t[1][0], t[2][0]});
}

/// Whether a turn about the axis, from its low to its high end, leaves the face's tetrahedron at the face.
/// The face's corners are counterclockwise from outside, so this holds if the face has low -> high.
bool Boundary::opens_turning(Index face, const Side& axis) const {
  const Triangle& corner = faces_[face].corners;
  const auto low =
      static_cast<std::size_t>(std::find(corner.begin(), corner.end(), axis.low) - corner.begin());
  return corner[(low + 1) % 3] == axis.high;
}

/// Sorts the faces at a side by the angle about it, from the first of them.
void Boundary::turn_sort(std::span<Side> fan) const {
  const double* low = at(fan[0].low);
  const double* high = at(fan[0].high);
  const auto third = [&](const Side& side) {
    for (const Index corner : faces_[side.face].corners)
      if (corner != side.low && corner != side.high) return at(corner);
    return low;
  };
  const double* zero = third(fan[0]);
  // Half a turn from `zero` is not 0: no two faces of an embedded boundary have the same angle.
  const auto half = [&](const Side& side) { return orient3d(low, high, zero, third(side)) <= 0; };
  std::sort(fan.begin() + 1, fan.end(), [&](const Side& x, const Side& y) {
    const bool late_x = half(x);
    const bool late_y = half(y);
    if (late_x != late_y) return late_y;
    return orient3d(low, high, third(x), third(y)) > 0;
  });
}

std::vector<Boundary::Cover> Boundary::covers(Pulse& pulse) const {
  DisjointSets sheets(faces_.size());
  std::vector<Side> sides = sorted_sides();
  for_each_fan(sides, [&](std::span<Side> fan) {
    pulse();
    if (fan.size() > 2) turn_sort(fan);
    bool alternate = true;
    for (std::size_t i = 1; i < fan.size(); ++i)
      alternate =
          alternate && opens_turning(fan[i].face, fan[i]) != opens_turning(fan[i - 1].face, fan[i - 1]);
    if (!alternate) return;
    for (const Side& side : fan.subspan(1)) sheets.join(fan[0].face, side.face);
  });
  std::vector<Cover> covers;
  for (const std::vector<Index>& sheet : sheets.members()) {
    // A ray along +x from the face with the largest x meets the fewest other faces.
    const Index face =
        *std::max_element(sheet.begin(), sheet.end(), [&](Index x, Index y) { return reach(x) < reach(y); });
    covers.push_back({face, cross(beside(face, true))});
  }
  return covers;
}

/// Join the outer sides of faces across the uncovered sectors at common sides. Let P be a set of faces
/// joined so, R the uncovered region beside it, and w the winding number of P. P bounds as a cycle; it
/// is embedded except where sectors touch, and w is r on the side of R, r + 1 on the other, for all of
/// P. Since w is 0 far away, r is 0 or -1. The sum of w at R over all sets beside R is 0 if R is the
/// unbounded region and -1 if not. So every bounded one has exactly one set with r = -1.
std::vector<Index> Boundary::voids() const {
  DisjointSets outer(faces_.size());
  std::vector<Side> sides = sorted_sides();
  for_each_fan(sides, [&](std::span<Side> fan) {
    if (fan.size() > 2) turn_sort(fan);
    for (std::size_t i = 0; i < fan.size(); ++i)
      if (opens_turning(fan[i].face, fan[i])) outer.join(fan[i].face, fan[(i + 1) % fan.size()].face);
  });
  std::vector<Index> found;
  for (const std::vector<Index>& set : outer.members()) {
    const Germ germ = beside(set[0], false);
    int winding = 0;
    for (const Index face : set) winding += crossing(face, germ);
    if (winding < 0) found.push_back(set[0]);
  }
  return found;
}

bool Boundary::outside(const Triangle& facet) const {
  const Corners t{at(facet[0]), at(facet[1]), at(facet[2])};
  if (collinear(t[0], t[1], t[2])) return false;
  const Box box = box_of(facet, vertices_);
  bool met = false;
  tree_.query([&](const Box& other) { return !met && other.meets(box); },
              [&](Index face) { met = met || meet_badly(facet, t, faces_[face].corners, corners(face)); });
  return !met && cross({{t[0], t[1], t[2]}, 3}) == 0;
}

bool Boundary::outside(const Segment& segment) const {
  const double* p = at(segment[0]);
  const double* q = at(segment[1]);
  if (std::equal(p, p + 3, q)) return false;
  const Box box = box_of(segment, vertices_);
  bool met = false;
  tree_.query(
      [&](const Box& other) { return !met && other.meets(box); },
      [&](Index face) { met = met || meet_badly(segment, p, q, faces_[face].corners, corners(face)); });
  return !met && cross({{p, q}, 2}) == 0;
}

bool Boundary::outside(Index vertex) const {
  const double* p = at(vertex);
  const Box box(vertices_[vertex]);
  bool met = false;
  tree_.query([&](const Box& other) { return !met && other.meets(box); },
              [&](Index face) { met = met || on_triangle(p, corners(face)); });
  return !met && cross({{p}, 1}) == 0;
}

}  // namespace holdfast::checking
