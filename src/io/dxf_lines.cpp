#include "io/dxf_lines.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "io/dxf_plane.h"
#include "io/dxf_spline.h"
#include "numbers/elementary.h"
#include "numbers/vector.h"

namespace holdfast::io {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
/// What six digits may differ from a length, as a share of it.
constexpr double kSixDigits = 1e-6;

/// A point on the arc from p to q: the share `k` of `count` of its angle. The chord to it is turned from the
/// chord to q by half of what remains; so arcs that are nearly straight need no centre far away.
Point on_arc(const Point& p, const Point& q, double bulge, std::size_t k, std::size_t count) {
  const double quarter = numbers::atan2(std::fabs(bulge), 1),
               share = static_cast<double>(k) / static_cast<double>(count);
  const double half_sine = 2 * std::fabs(bulge) / (1 + bulge * bulge);
  const double length = numbers::sin(2 * quarter * share) / half_sine;
  const double turn = 2 * quarter * (1 - share) * (bulge > 0 ? -1 : 1);
  const double s = length * numbers::sin(turn), c = length * numbers::cos(turn);
  const double x = q[0] - p[0], y = q[1] - p[1];
  return {p[0] + c * x - s * y, p[1] + s * x + c * y, p[2]};
}

Point on_circle(const Point& centre, double radius, double degrees) {
  const Placement turn = Placement::turned({}, {0, 0, 1}, std::fmod(degrees, 360));
  const Point p = turn.of({radius, 0, 0});
  return {centre[0] + p[0], centre[1] + p[1], centre[2]};
}

/// The angle of an arc, counterclockwise: above 0 and at most 360 degrees.
double turn_of(double from, double to) {
  const double angle = std::fmod(to - from, 360);
  return angle <= 0 ? angle + 360 : angle;
}

}  // namespace

void Outline::add(DxfText& text, const DxfEntity& entity) {
  Point corner = text.point(entity, 10);
  if (!in_space) corner[2] = elevation;
  corners.push_back(corner);
  bulges.push_back(text.real(entity, 42, 0));
}

Outline outline_of_polyline(DxfText& text, const DxfEntity& entity) {
  constexpr std::int64_t kClosed = 1, kInSpace = 8;
  const std::int64_t flags = text.integer(entity, 70, 0);
  Outline outline;
  outline.closed = (flags & kClosed) != 0;
  outline.in_space = (flags & kInSpace) != 0;
  outline.elevation = text.real(entity, 30, 0);
  if (!outline.in_space) outline.plane = placement_of_plane(text, entity);
  outline.place = entity.place;
  return outline;
}

bool DxfLines::add(MeshData& mesh, DxfText& text, const DxfEntity& entity, int layer) {
  if (entity.type == "LINE") {
    Outline line;
    line.corners = {text.point(entity, 10), text.point(entity, 11)};
    line.bulges = {0, 0};
    add(mesh, text, line, layer);
  } else if (entity.type == "LWPOLYLINE") {
    add_light_polyline(mesh, text, entity, layer);
  } else if (entity.type == "ARC" || entity.type == "CIRCLE") {
    add_arc(mesh, text, entity, layer);
  } else if (entity.type == "ELLIPSE") {
    add_ellipse(mesh, text, entity, layer);
  } else if (entity.type == "SPLINE") {
    return add_spline(mesh, text, entity, layer);
  } else {
    return false;
  }
  return true;
}

void DxfLines::add_light_polyline(MeshData& mesh, DxfText& text, const DxfEntity& entity, int layer) {
  Outline outline;
  outline.closed = text.integer(entity, 70, 0) % 2 != 0;
  outline.elevation = text.real(entity, 38, 0);
  outline.plane = placement_of_plane(text, entity);
  outline.place = entity.place;
  for (const DxfGroup& group : entity.groups) {
    if (group.code == 10) {
      outline.corners.push_back({text.real(group), 0, outline.elevation});
      outline.bulges.push_back(0);
    } else if (group.code == 20 && !outline.corners.empty()) {
      outline.corners.back()[1] = text.real(group);
    } else if (group.code == 42 && !outline.corners.empty()) {
      outline.bulges.back() = text.real(group);
    }
  }
  add(mesh, text, outline, layer);
}

void DxfLines::add(MeshData& mesh, const DxfText& text, const Outline& outline, int layer) {
  const std::vector<Point>& corners = outline.corners;
  if (corners.size() < 2) return;
  const auto first = static_cast<Index>(mesh.vertices.size());
  const auto put = [&](const Point& p) {
    mesh.vertices.push_back(outline.plane.of(p));
    return static_cast<Index>(mesh.vertices.size() - 1);
  };
  Index last = put(corners[0]);
  const std::size_t sides = corners.size() - (outline.closed ? 0 : 1);
  for (std::size_t i = 0; i < sides; ++i) {
    const bool is_back = i + 1 == corners.size();
    const Point &p = corners[i], &q = corners[is_back ? 0 : i + 1];
    if (p == q) continue;  // as when a closed polyline repeats its first corner
    const double bulge = outline.bulges[i];
    if (!std::isfinite(bulge)) text.fail_at(outline.place, "a bulge that is not finite");
    const std::size_t pieces =
        bulge == 0 ? 1 : pieces_of(text, outline.place, 4 * numbers::atan2(std::fabs(bulge), 1) / kDegree);
    for (std::size_t k = 1; k <= pieces; ++k) {
      const Index next = k < pieces ? put(on_arc(p, q, bulge, k, pieces)) : is_back ? first : put(q);
      mesh.add_segment({last, next}, layer);
      last = next;
    }
  }
  for (const Index end : {first, last}) line_ends_.push_back(end);
}

void DxfLines::add_arc(MeshData& mesh, DxfText& text, const DxfEntity& entity, int layer) {
  const bool is_circle = entity.type == "CIRCLE";
  const Point centre = text.point(entity, 10);
  const double radius = text.real(entity, 40, 0);
  const double from = is_circle ? 0 : text.real(entity, 50, 0),
               to = is_circle ? 360 : text.real(entity, 51, 360);
  if (!(radius >= 0) || !std::isfinite(radius) || !std::isfinite(from) || !std::isfinite(to))
    text.fail_at(entity.place, "an arc whose radius is negative, or whose numbers are not finite");
  if (radius == 0) return;  // a point
  const double angle = turn_of(from, to);
  const std::size_t pieces = pieces_of(text, entity.place, angle);
  const Placement plane = placement_of_plane(text, entity);
  const auto at = [&](double share) {
    return plane.of(on_circle(centre, radius, share == 1 ? to : from + angle * share));
  };
  add_curve(mesh, pieces, is_circle, radius, at, layer);
}

// Unlike those of other lines, its coordinates are those of space. Its parameters are angles before the
// circle is flattened.
void DxfLines::add_ellipse(MeshData& mesh, DxfText& text, const DxfEntity& entity, int layer) {
  const Point centre = text.point(entity, 10), major = text.point(entity, 11);
  const double ratio = text.real(entity, 40, 1);
  const double from = text.real(entity, 41, 0) / kDegree, to = text.real(entity, 42, 360 * kDegree) / kDegree;
  const double radius = length(major);
  if (!std::isfinite(radius) || !std::isfinite(ratio) || !std::isfinite(from) || !std::isfinite(to))
    text.fail_at(entity.place, "an ellipse whose numbers are not finite");
  if (radius == 0) return;
  const Vector minor = cross(placement_of_plane(text, entity).of({0, 0, 1}), major);
  const double angle = turn_of(from, to);
  const bool is_whole = angle > 360 * (1 - kSixDigits);
  const auto at = [&](double share) {
    const Point p = on_circle({}, 1, share == 1 ? to : from + angle * share);
    Point q{};
    for (std::size_t k = 0; k < 3; ++k) q[k] = centre[k] + p[0] * major[k] + p[1] * ratio * minor[k];
    return q;
  };
  add_curve(mesh, pieces_of(text, entity.place, angle), is_whole, radius, at, layer);
}

bool DxfLines::add_spline(MeshData& mesh, DxfText& text, const DxfEntity& entity, int layer) {
  const std::optional<DxfSpline> spline = DxfSpline::read(text, entity);
  if (!spline) return false;
  require_step(text, entity.place);
  const std::vector<Point> points = spline->points(arc_step_);
  if (points.size() < 2) return true;  // a point
  double reach = 0;
  for (const Point& p : points) reach = std::max(reach, numbers::distance(points.front(), p));
  const bool is_closed =
      points.size() > 3 && numbers::distance(points.front(), points.back()) <= kSixDigits * reach;
  const auto first = static_cast<Index>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), points.begin(), points.end() - (is_closed ? 1 : 0));
  const auto last = static_cast<Index>(mesh.vertices.size() - 1);
  for (Index v = first; v < last; ++v) mesh.add_segment({v, v + 1}, layer);
  if (is_closed) mesh.add_segment({last, first}, layer);
  for (const Index end : {first, last}) line_ends_.push_back(end);
  return true;
}

void DxfLines::add_curve(MeshData& mesh, std::size_t pieces, bool is_closed, double radius,
                         const std::function<Point(double)>& at, int layer) {
  pieces = std::max<std::size_t>(pieces, is_closed ? 3 : 1);
  const auto first = static_cast<Index>(mesh.vertices.size());
  for (std::size_t k = 0; k <= pieces - (is_closed ? 1 : 0); ++k)
    mesh.vertices.push_back(at(static_cast<double>(k) / static_cast<double>(pieces)));
  for (std::size_t k = 0; k < pieces; ++k) {
    const auto a = static_cast<Index>(first + k);
    mesh.add_segment({a, is_closed && k + 1 == pieces ? first : a + 1}, layer);
  }
  if (is_closed) return;
  arc_ends_.push_back({first, radius});
  arc_ends_.push_back({static_cast<Index>(first + pieces), radius});
}

void DxfLines::require_step(const DxfText& text, std::size_t place) const {
  if (arc_step_ == 0)
    text.fail_at(place,
                 "an arc (ARC, CIRCLE, ELLIPSE, SPLINE, or a bulge of a polyline); arcs are divided into "
                 "straight pieces if "
                 "an angle for these is given (arcs, in degrees)");
}

std::size_t DxfLines::pieces_of(const DxfText& text, std::size_t place, double degrees) const {
  require_step(text, place);
  constexpr double kRounding = 1e-9;  // 90 degrees in steps of 10 are nine pieces
  return static_cast<std::size_t>(std::max(1.0, std::ceil(degrees / arc_step_ - kRounding)));
}

void DxfLines::join_ends(MeshData& mesh) const {
  if (arc_ends_.empty()) return;
  // Ends of lines come first; of two arcs, the later one gets the place of the earlier one.
  std::multimap<double, Index> settled;
  for (const Index end : line_ends_) settled.emplace(mesh.vertices[end][0], end);
  for (const auto& [vertex, radius] : arc_ends_) {
    Point& end = mesh.vertices[vertex];
    const double reach = kSixDigits * radius;
    double least = reach;
    Index nearest = no_entity;
    for (auto at = settled.lower_bound(end[0] - reach); at != settled.end() && at->first <= end[0] + reach;
         ++at) {
      const double apart = numbers::distance(mesh.vertices[at->second], end);
      if (apart > least || (apart == least && nearest != no_entity)) continue;
      least = apart;
      nearest = at->second;
    }
    if (nearest != no_entity) end = mesh.vertices[nearest];
    settled.emplace(end[0], vertex);
  }
}

}  // namespace holdfast::io
