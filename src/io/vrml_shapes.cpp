// Box, ElevationGrid and Extrusion as ISO/IEC 14772-1, 6.5, 6.17 and 6.18 define them; Cube is the Box of
// version 1.0.
#include "io/vrml_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "io/placement.h"

namespace holdfast::io {
namespace {

/// Points of a grid or an extrusion, which a short file could ask for by the million.
constexpr std::size_t kMostPoints = std::size_t{1} << 24;

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot_of(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross_of_vectors(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// Nothing for a vector without a direction.
std::optional<Point> direction(const Point& p) {
  const double length = std::sqrt(dot_of(p, p));
  if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
  return Point{p[0] / length, p[1] / length, p[2] / length};
}

class ShapeFaces {
 public:
  ShapeFaces(const VrmlScene& scene, const VrmlNode& shape) : scene_(scene), shape_(shape) {}

  VrmlFaces read() {
    if (shape_.type == "ElevationGrid")
      add_grid();
    else if (shape_.type == "Extrusion")
      add_extrusion();
    else
      add_box();
    if (is_false("ccw"))
      for (std::vector<Index>& face : result_.faces) std::reverse(face.begin(), face.end());
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const { scene_.fail(shape_, reason); }
  [[nodiscard]] bool is_false(std::string_view field) const { return shape_.field(field).word == "FALSE"; }
  /// Rows of `width` numbers, or those by default.
  [[nodiscard]] std::vector<double> rows(std::string_view field, std::size_t width,
                                         std::vector<double> otherwise) const {
    const std::vector<double>& given = shape_.field(field).numbers;
    if (given.empty()) return otherwise;
    if (given.size() % width != 0)
      fail("the field '" + std::string(field) + "' has " + std::to_string(given.size()) +
           " numbers, no multiple of " + std::to_string(width));
    return given;
  }
  [[nodiscard]] double number(std::string_view field, double otherwise) const {
    const std::vector<double>& given = shape_.field(field).numbers;
    return given.empty() ? otherwise : given[0];
  }

  void add_box() {
    const std::vector<double> sizes =
        shape_.type == "Cube"
            ? std::vector<double>{number("width", 2), number("height", 2), number("depth", 2)}
            : rows("size", 3, {2, 2, 2});
    for (unsigned v = 0; v < 8; ++v) {
      Point p;
      for (unsigned axis = 0; axis < 3; ++axis)
        p[axis] = ((v >> axis) & 1U) != 0 ? sizes[axis] / 2 : -sizes[axis] / 2;
      result_.points.push_back(p);
    }
    result_.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  }

  void add_grid() {
    const double x_size = number("xDimension", 0), z_size = number("zDimension", 0);
    const std::vector<double>& heights = shape_.field("height").numbers;
    const auto counts = [](double number) { return number >= 0 && number == std::floor(number); };
    if (!counts(x_size) || !counts(z_size) || x_size * z_size != static_cast<double>(heights.size()))
      fail("an ElevationGrid with " + std::to_string(heights.size()) +
           " heights, which are not xDimension times zDimension");
    if (heights.empty()) return;
    const double x_step = number("xSpacing", 1), z_step = number("zSpacing", 1);
    const auto columns = static_cast<std::size_t>(x_size), lines = static_cast<std::size_t>(z_size);
    for (std::size_t i = 0; i < heights.size(); ++i)
      result_.points.push_back(
          {static_cast<double>(i % columns) * x_step, heights[i], static_cast<double>(i / columns) * z_step});
    for (std::size_t z = 0; z + 1 < lines; ++z)
      for (std::size_t x = 0; x + 1 < columns; ++x) {
        const auto a = static_cast<Index>(z * columns + x), below = static_cast<Index>(a + columns);
        result_.faces.push_back({a, below, below + 1, a + 1});
      }
  }

  /// The axes of the cross-section at each point of the spine ("SCP").
  struct Axes {
    Point x, y, z;
  };
  static std::vector<Axes> axes_along(const std::vector<Point>& spine, bool closed) {
    const std::size_t n = spine.size();
    const auto before = [&](std::size_t i) { return i > 0 ? i - 1 : closed ? n - 2 : 0; };
    const auto behind = [&](std::size_t i) { return i + 1 < n ? i + 1 : closed ? 1 : n - 1; };
    std::vector<std::optional<Point>> up(n), side(n);
    for (std::size_t i = 0; i < n; ++i) {
      up[i] = direction(minus(spine[behind(i)], spine[before(i)]));
      side[i] =
          direction(cross_of_vectors(minus(spine[behind(i)], spine[i]), minus(spine[before(i)], spine[i])));
    }
    // What has no direction has that of its neighbour.
    const auto spread = [&](std::vector<std::optional<Point>>& of) {
      for (std::size_t i = 1; i < n; ++i)
        if (!of[i]) of[i] = of[i - 1];
      for (std::size_t i = n - 1; i-- > 0;)
        if (!of[i]) of[i] = of[i + 1];
    };
    spread(up);
    spread(side);
    std::vector<Axes> axes;
    for (std::size_t i = 0; i < n; ++i) {
      const Point y = up[i].value_or(Point{0, 1, 0});
      Point z = side[i].value_or(straight_side(y));
      if (!axes.empty() && dot_of(z, axes.back().z) < 0) z = {-z[0], -z[1], -z[2]};
      axes.push_back({cross_of_vectors(y, z), y, z});
    }
    return axes;
  }
  /// For a straight spine: the z axis after the turn that takes the y axis to it.
  static Point straight_side(const Point& y) {
    const std::optional<Point> axis = direction(cross_of_vectors({0, 1, 0}, y));
    if (!axis) return {0, 0, 1};
    // Rodrigues' formula with the cosine y[1].
    const Point z{0, 0, 1}, turned = cross_of_vectors(*axis, z);
    const double c = y[1], s = std::sqrt(std::max(0.0, 1 - c * c)), along = dot_of(*axis, z) * (1 - c);
    return {z[0] * c + turned[0] * s + (*axis)[0] * along, z[1] * c + turned[1] * s + (*axis)[1] * along,
            z[2] * c + turned[2] * s + (*axis)[2] * along};
  }

  void add_extrusion() {
    const std::vector<double> section = rows("crossSection", 2, {1, 1, 1, -1, -1, -1, -1, 1, 1, 1});
    const std::vector<double> path = rows("spine", 3, {0, 0, 0, 0, 1, 0});
    std::vector<Point> spine;
    for (std::size_t i = 0; i < path.size(); i += 3) spine.push_back({path[i], path[i + 1], path[i + 2]});
    std::size_t corners = section.size() / 2;
    const bool ring =
        corners > 2 && section[0] == section[2 * corners - 2] && section[1] == section[2 * corners - 1];
    const bool closed = spine.size() > 2 && spine.front() == spine.back();
    if (ring) --corners;
    if (spine.size() < 2 || corners < 2)
      fail("an Extrusion needs two points of its spine and of its cross-section");
    if (spine.size() > kMostPoints / corners) fail("an Extrusion of more than 16 million points");
    const std::vector<Axes> axes = axes_along(spine, closed);
    const std::size_t rings = spine.size() - (closed ? 1 : 0);
    scales_ = rows("scale", 2, {1, 1});
    turns_ = rows("orientation", 4, {0, 0, 1, 0});
    for (std::size_t i = 0; i < rings; ++i) add_ring(section, corners, i, spine[i], axes[i]);
    const auto at = [&](std::size_t i, std::size_t k) {
      return static_cast<Index>(i % rings * corners + k % corners);
    };
    for (std::size_t i = 0; i + 1 < spine.size(); ++i)
      for (std::size_t k = 0; k + (ring ? 0 : 1) < corners; ++k)
        result_.faces.push_back({at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)});
    if (closed) return;  // caps would lie inside
    std::vector<Index> begin, end;
    for (std::size_t k = 0; k < corners; ++k) {
      begin.push_back(at(0, corners - 1 - k));
      end.push_back(at(rings - 1, k));
    }
    if (!is_false("beginCap")) result_.faces.push_back(std::move(begin));
    if (!is_false("endCap")) result_.faces.push_back(std::move(end));
  }

  void add_ring(const std::vector<double>& section, std::size_t corners, std::size_t i, const Point& centre,
                const Axes& axes) {
    const std::size_t scale = std::min(i, scales_.size() / 2 - 1) * 2,
                      turn = std::min(i, turns_.size() / 4 - 1) * 4;
    Placement turned;
    if (const auto axis = direction({turns_[turn], turns_[turn + 1], turns_[turn + 2]});
        axis && turns_[turn + 3] != 0)
      turned = Placement::turned({}, *axis, turns_[turn + 3] * 180 / std::numbers::pi);
    for (std::size_t k = 0; k < corners; ++k) {
      const Point p =
          turned.of({section[2 * k] * scales_[scale], 0, section[2 * k + 1] * scales_[scale + 1]});
      Point placed = centre;
      for (std::size_t c = 0; c < 3; ++c) placed[c] += axes.x[c] * p[0] + axes.y[c] * p[1] + axes.z[c] * p[2];
      result_.points.push_back(placed);
    }
  }

  const VrmlScene& scene_;
  const VrmlNode& shape_;
  std::vector<double> scales_, turns_;  ///< of an extrusion: 2 and 4 numbers for each point of its spine
  VrmlFaces result_;
};

}  // namespace

bool is_polyhedron(std::string_view type) {
  return type == "Box" || type == "Cube" || type == "ElevationGrid" || type == "Extrusion";
}

VrmlFaces faces_of_shape(const VrmlScene& scene, const VrmlNode& shape) {
  return ShapeFaces(scene, shape).read();
}

}  // namespace holdfast::io
