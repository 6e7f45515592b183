#include "plane/criteria.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numbers/elementary.h"

namespace holdfast::plane {

Criteria::Criteria(const GrowingMesh& growing, const RefineOptions& options)
    : growing_(growing), keep_boundary_(options.keep_boundary) {
  constexpr double kDegree = 3.14159265358979323846 / 180;
  bound_ = options.angle > 0 ? numbers::cos(options.angle * kDegree) : 1;
  // The height over the base of the isosceles triangle whose least angle is the bound; a little less, so that
  // rounding leaves the angle above the bound.
  const double half = options.angle * kDegree / 2;
  off_ = options.angle > 0 ? 0.475 * numbers::cos(half) / numbers::sin(half) : 0;
  const double size = growing.scale().length_down(options.size);
  // A square below the range of doubles would round to 0, which means no limit.
  size2_ = options.size > 0 ? std::max(size * size, std::numeric_limits<double>::min()) : 0;
  for (const double area : options.areas) areas_.push_back(area > 0 ? growing.scale().area_down(area) : 0);
}

// --- Constraints ---

bool Criteria::must_cut(EdgeCode e) const {
  const Triangles& mesh = growing_.mesh();
  const Vertex a = mesh.from(e), b = mesh.to(e);
  if (size2_ > 0 && squared(growing_.at(a), growing_.at(b)) > size2_) return true;
  if (is_encroached(mesh.apex(e), a, b)) return true;
  const EdgeCode f = mesh.across(e);
  return f != kNoEdge && is_encroached(mesh.apex(f), a, b);
}

bool Criteria::is_encroached(Vertex p, Vertex a, Vertex b) const {
  const InputSegments& segments = growing_.segments();
  return encroaches(p, a, b) &&
         (segments.below(p) == kNoSegment || !segments.make_needle(segments.of(a, b), segments.below(p)));
}

bool Criteria::hurts(Vertex p, EdgeCode e, bool for_size) const {
  if (!keep_boundary_) return encroaches(p, growing_.mesh().from(e), growing_.mesh().to(e));
  const Position &a = growing_.from(e), &b = growing_.to(e);
  if (for_size && size2_ > 0) {
    const double cross = cross_from(a, b, growing_.at(p)), side2 = squared(a, b),
                 height2 = cross * cross / side2;
    return height2 < kClose * kClose * std::min(size2_, side2);
  }
  const double cosine = Shape(growing_.at(p), a, b).cosine;
  return cosine > bound_ && cosine > growing_.shape_of(triangle_of(e)).cosine;
}

// --- Triangles ---

bool Criteria::is_large(std::uint32_t t, const Shape& shape) const {
  const Triangles& mesh = growing_.mesh();
  const std::uint32_t mark = mesh[t].mark;
  if (mark < areas_.size() && areas_[mark] > 0 && growing_.area_of(t) > areas_[mark]) return true;
  if (size2_ == 0) return false;
  for (std::uint32_t i = 0; i < 3; ++i)
    if (shape.edges[i] > size2_ && !(keep_boundary_ && mesh.constrained(code(t, i)))) return true;
  return false;
}

bool Criteria::is_thin_for_input(std::uint32_t t, const Shape& shape) const {
  const EdgeCode e = code(t, shape.shortest);
  return is_across(t, shape) || is_between_constraints(t, shape) ||
         growing_.segments().any_make_needle(growing_.mesh().from(e), growing_.mesh().to(e));
}

// Whether the least angle lies opposite two cuts at the same distance from a corner of the input where two
// segments meet at less than 60 degrees, or at such a corner itself.
bool Criteria::is_across(std::uint32_t t, const Shape& shape) const {
  const InputSegments& segments = growing_.segments();
  const EdgeCode e = code(t, shape.shortest);
  const Vertex a = growing_.mesh().from(e), b = growing_.mesh().to(e);
  const std::uint32_t s = segments.below(a), r = segments.below(b);
  if (s == kNoSegment || r == kNoSegment || s == r) return false;
  const Vertex v = segments.common_corner(s, r);
  if (v == kNoVertex) return false;
  if (segments.make_needle(s, r)) return true;
  // At 60 degrees or more the edge between them is not the shortest.
  const double p = std::sqrt(squared(growing_.at(v), growing_.at(a)));
  const double q = std::sqrt(squared(growing_.at(v), growing_.at(b)));
  return std::abs(p - q) <= kSame * std::max(p, q) && shape.edges[shape.shortest] < p * q;
}

// Whether the least angle lies between two constraints; then no point makes it larger.
bool Criteria::is_between_constraints(std::uint32_t t, const Shape& shape) const {
  return growing_.mesh().constrained(code(t, (shape.shortest + 1) % 3)) &&
         growing_.mesh().constrained(code(t, (shape.shortest + 2) % 3));
}

// --- Places ---

Position Criteria::centre_of(std::uint32_t t) const {
  const std::array<Vertex, 3>& v = growing_.mesh()[t].v;
  return circumcentre(growing_.at(v[0]), growing_.at(v[1]), growing_.at(v[2]));
}

Position Criteria::off_centre(std::uint32_t t, const Shape& shape, const Position& centre) const {
  if (off_ == 0) return centre;
  const EdgeCode e = code(t, shape.shortest);
  const Position &a = growing_.from(e), &b = growing_.to(e);
  const Position m = middle(a, b);
  // Perpendicular to ab, on its left.
  const Position off{m[0] - off_ * (b[1] - a[1]), m[1] + off_ * (b[0] - a[0])};
  return squared(m, off) < squared(m, centre) || !std::isfinite(centre[0] + centre[1]) ? off : centre;
}

Position Criteria::middle_of_longest(std::uint32_t t, const Shape& shape) const {
  EdgeCode longest = kNoEdge;
  for (std::uint32_t i = 0; i < 3; ++i)
    if (!growing_.mesh().constrained(code(t, i)) &&
        (longest == kNoEdge || shape.edges[i] > shape.edges[edge_of(longest)]))
      longest = code(t, i);
  if (longest == kNoEdge) longest = code(t, 0);
  return middle(growing_.from(longest), growing_.to(longest));
}

}  // namespace holdfast::plane
