// VRML 1.0 and 2.0 (VRML97, ISO/IEC 14772-1): indexed face sets and shapes that are polyhedra, placed by the
// scene, possibly several times.
// Axes and unit are those of the file.
#include "io/vrml_read.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include "io/labels.h"
#include "io/polygon.h"
#include "io/solids.h"
#include "io/vrml_scene.h"
#include "io/vrml_shapes.h"
#include "text/decimal.h"

namespace holdfast::io {
namespace {

/// Shapes that are skipped.
constexpr std::string_view kShapes[] = {"AsciiText", "Cone",           "Cylinder", "GeoElevationGrid",
                                        "Sphere",    "IndexedLineSet", "PointSet", "Text"};

/// VRML97 nodes that stand in place of shapes but are none.
constexpr std::string_view kOtherNodes[] = {"AudioClip",
                                            "Background",
                                            "ColorInterpolator",
                                            "CoordinateInterpolator",
                                            "CylinderSensor",
                                            "DirectionalLight",
                                            "Fog",
                                            "NavigationInfo",
                                            "NormalInterpolator",
                                            "OrientationInterpolator",
                                            "PlaneSensor",
                                            "PointLight",
                                            "PositionInterpolator",
                                            "ProximitySensor",
                                            "ScalarInterpolator",
                                            "Script",
                                            "Sound",
                                            "SphereSensor",
                                            "SpotLight",
                                            "TimeSensor",
                                            "TouchSensor",
                                            "Viewpoint",
                                            "VisibilitySensor",
                                            "WorldInfo"};

/// The state that nodes of version 1.0 pass on to those that follow.
struct State {
  Placement placement;
  const VrmlNode* coordinates = nullptr;
  bool is_clockwise = false;
};

class VrmlReader {
 public:
  explicit VrmlReader(const Source& source)
      : source_(source), scene_(source), part_source_(source), solids_(source) {
    part_source_.keeps_polygons = false;
  }

  MeshData read() {
    State state;
    for (const VrmlNode* root : scene_.roots()) visit(*root, state, {});
    MeshData mesh = solids_.take();
    mesh.polygon_counts = polygon_counts_;
    mesh.leave_out(
        left_out_, [](const std::string& type) { return type; }, "shapes that are no sets of faces",
        "shape that is no set of faces");
    mesh.leave_out(inlines_, "scenes of other files", "scene of another file");
    mesh.leave_out(own_kinds_, "nodes of kinds that the file defines",
                   "node of a kind that the file defines");
    return mesh;
  }

 private:
  // A node may be used many times, including its contents.
  static constexpr std::size_t kDeepest = 256, kMostVisits = std::size_t{1} << 21;

  void visit(const VrmlNode& node, State& state, const std::string& name_around) {
    if (++depth_ > kDeepest) scene_.fail(node, "nodes stand more than " + std::to_string(kDeepest) + " deep");
    if (++visits_ > kMostVisits)
      scene_.fail(node, "nodes are used more than " + std::to_string(kMostVisits) +
                            " times; such a file is damaged or malicious");
    step(source_.watch);
    // In version 2.0, the shape and the nodes around it have better names than the geometry.
    const bool is_geometry =
        !scene_.is_first_version() && (node.type == "IndexedFaceSet" || is_polyhedron(node.type));
    const bool around = node.name.empty() || (is_geometry && !name_around.empty());
    const std::string& name = around ? name_around : node.name;
    if (scene_.is_first_version())
      visit_first(node, state, name);
    else
      visit_second(node, state, name);
    --depth_;
  }

  void visit_all(const std::vector<const VrmlNode*>& nodes, State& state, const std::string& name) {
    for (const VrmlNode* node : nodes)
      if (node != nullptr) visit(*node, state, name);
  }

  void visit_first(const VrmlNode& node, State& state, const std::string& name) {
    const std::string& type = node.type;
    if (type == "Separator" || type == "WWWAnchor") {
      State inside = state;
      visit_all(node.children, inside, name);
    } else if (type == "TransformSeparator") {
      const Placement before = state.placement;
      visit_all(node.children, state, name);
      state.placement = before;
    } else if (type == "Group") {
      visit_all(node.children, state, name);
    } else if (type == "Switch") {
      const auto which = choice(node.field("whichChild"), node.children.size());
      if (which.second == every)
        visit_all(node.children, state, name);
      else if (which.second == one)
        visit(*node.children[which.first], state, name);
    } else if (type == "LOD" || type == "LevelOfDetail") {
      if (!node.children.empty()) visit(*node.children[0], state, name);
    } else if (type == "Coordinate3") {
      state.coordinates = &node;
    } else if (type == "ShapeHints") {
      const std::string& order = node.field("vertexOrdering").word;
      if (!order.empty()) state.is_clockwise = order == "CLOCKWISE";
    } else if (type == "Transform" || type == "Translation" || type == "Scale") {
      state.placement = state.placement.after(transform(node, "scaleFactor"));
    } else if (type == "Rotation") {
      state.placement = state.placement.after(turn(node, "rotation"));
    } else if (type == "MatrixTransform") {
      state.placement = state.placement.after(matrix(node));
    } else if (type == "IndexedFaceSet") {
      if (state.coordinates == nullptr) scene_.fail(node, "there is no Coordinate3 before the faces");
      put(node, *state.coordinates, state.is_clockwise, state.placement, name);
    } else if (type == "Cube") {
      put_shape(node, state.placement, name);
    } else if (type == "WWWInline") {
      ++inlines_;
    } else if (is_shape(type)) {
      ++left_out_[type];
    }
  }

  void visit_second(const VrmlNode& node, State& state, const std::string& name) {
    const std::string& type = node.type;
    if (type == "Transform") {
      State inside = state;
      inside.placement = state.placement.after(transform(node, "scale"));
      visit_all(node.field("children").nodes, inside, name);
    } else if (type == "Group" || type == "Anchor" || type == "Billboard" || type == "Collision") {
      visit_all(node.field("children").nodes, state, name);
    } else if (type == "Switch") {
      const VrmlField& choices = node.field("choice");
      const auto which = choice(node.field("whichChoice"), choices.nodes.size());
      if (which.second == one) visit_all({choices.nodes[which.first]}, state, name);
    } else if (type == "LOD") {
      const VrmlField& levels = node.field("level");
      if (!levels.nodes.empty()) visit_all({levels.nodes[0]}, state, name);
    } else if (type == "Shape") {
      visit_all(node.field("geometry").nodes, state, name);
    } else if (type == "IndexedFaceSet") {
      const VrmlField& coordinates = node.field("coord");
      if (!coordinates.nodes.empty() && coordinates.nodes[0] != nullptr)
        put(node, *coordinates.nodes[0], node.field("ccw").word == "FALSE", state.placement, name);
    } else if (is_polyhedron(type)) {
      put_shape(node, state.placement, name);
    } else if (type == "Inline") {
      ++inlines_;
    } else if (is_shape(type)) {
      ++left_out_[type];
    } else {
      own_kinds_ += is_known(type) ? 0 : 1;
    }
  }

  enum Choice { none, one, every };
  /// The child that a switch selects.
  static std::pair<std::size_t, Choice> choice(const VrmlField& which, std::size_t count) {
    const double number = which.numbers.empty() ? -1 : which.numbers[0];
    if (number == -3) return {0, every};
    if (!(number >= 0 && number < static_cast<double>(count))) return {0, none};
    return {static_cast<std::size_t>(number), one};
  }

  static bool is_shape(std::string_view type) {
    return std::find(std::begin(kShapes), std::end(kShapes), type) != std::end(kShapes);
  }
  static bool is_known(std::string_view type) {
    return std::find(std::begin(kOtherNodes), std::end(kOtherNodes), type) != std::end(kOtherNodes);
  }

  [[nodiscard]] std::vector<double> numbers(const VrmlNode& node, std::string_view field,
                                            std::vector<double> otherwise) const {
    const auto found = node.fields.find(field);
    if (found == node.fields.end()) return otherwise;
    if (found->second.numbers.size() != otherwise.size())
      scene_.fail(node, "the field " + in_quotes(field) + " has " +
                            std::to_string(found->second.numbers.size()) + " numbers instead of " +
                            std::to_string(otherwise.size()));
    return found->second.numbers;
  }

  [[nodiscard]] Point vector(const VrmlNode& node, std::string_view field, double otherwise = 0) const {
    const std::vector<double> v = numbers(node, field, {otherwise, otherwise, otherwise});
    return {v[0], v[1], v[2]};
  }

  /// A rotation about an axis by an angle in radians.
  [[nodiscard]] Placement turn(const VrmlNode& node, std::string_view field, double sense = 1) const {
    const std::vector<double> v = numbers(node, field, {0, 0, 1, 0});
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (v[3] == 0 || !(length > 0) || !std::isfinite(length * v[3])) return {};
    return Placement::turned({}, {v[0] / length, v[1] / length, v[2] / length},
                             sense * v[3] * 180 / std::numbers::pi);
  }

  [[nodiscard]] Placement transform(const VrmlNode& node, std::string_view scale) const {
    const Point centre = vector(node, "center"), s = vector(node, scale, 1);
    Placement scaled;
    for (std::size_t axis = 0; axis < 3; ++axis) scaled.m[4 * axis] = s[axis];
    return Placement::moved_by(vector(node, "translation"))
        .after(Placement::moved_by(centre))
        .after(turn(node, "rotation"))
        .after(turn(node, "scaleOrientation"))
        .after(scaled)
        .after(turn(node, "scaleOrientation", -1))
        .after(Placement::moved_by({-centre[0], -centre[1], -centre[2]}));
  }

  /// A matrix of rows; the last one is the translation.
  [[nodiscard]] Placement matrix(const VrmlNode& node) const {
    const std::vector<double> v = numbers(node, "matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    Placement result;
    for (std::size_t row = 0; row < 4; ++row)
      for (std::size_t axis = 0; axis < 3; ++axis) result.m[3 * row + axis] = v[4 * row + axis];
    return result;
  }

  void put(const VrmlNode& faces, const VrmlNode& coordinates, bool clockwise, const Placement& placement,
           const std::string& name) {
    const auto [there, fresh] = solids_of_.try_emplace({&faces, &coordinates, clockwise});
    if (fresh) there->second = solid(faces, coordinates, clockwise);
    if (!there->second.facets.empty()) solids_.add(there->second, name, placement);
  }

  void put_shape(const VrmlNode& shape, const Placement& placement, const std::string& name) {
    const auto [there, fresh] = solids_of_.try_emplace({&shape, &shape, false});
    if (fresh) {
      VrmlFaces faces = faces_of_shape(scene_, shape);
      MeshData part(part_source_);
      part.vertices = std::move(faces.points);
      for (const std::vector<Index>& face : faces.faces) {
        beat(source_.watch);
        add_face(part, face, 0, [&](const std::string& reason) { scene_.fail(shape, reason); });
      }
      there->second = solid_of(std::move(part));
    }
    if (!there->second.facets.empty()) solids_.add(there->second, name, placement);
  }

  [[nodiscard]] Solid solid(const VrmlNode& faces, const VrmlNode& coordinates, bool clockwise) {
    MeshData part(part_source_);
    const std::vector<double>& points = coordinates.field("point").numbers;
    if (points.size() % 3 != 0)
      scene_.fail(coordinates, std::to_string(points.size()) + " coordinates are no whole points");
    for (std::size_t i = 0; i < points.size(); i += 3)
      part.vertices.push_back({points[i], points[i + 1], points[i + 2]});
    std::vector<Index> corners;
    const auto end_face = [&] {
      if (corners.empty()) return;
      if (clockwise) std::reverse(corners.begin(), corners.end());
      add_face(part, corners, 0, [&](const std::string& reason) { scene_.fail(faces, reason); });
      corners.clear();
    };
    for (const double index : faces.field("coordIndex").numbers) {
      beat(source_.watch);
      if (index < 0) {
        end_face();
        continue;
      }
      if (!(index < static_cast<double>(part.vertices.size())) || index != std::floor(index))
        scene_.fail(faces, "a face names point " + decimal(index) + ", but there are " +
                               std::to_string(part.vertices.size()));
      corners.push_back(static_cast<Index>(index));
    }
    end_face();
    return solid_of(std::move(part));
  }

  [[nodiscard]] Solid solid_of(MeshData&& part) {
    polygon_counts_.add(part.polygon_counts);
    return {{}, std::move(part.vertices), std::move(part.facets), {}, {}};
  }

  Source source_;
  VrmlScene scene_;
  Source part_source_;
  Solids solids_;
  std::map<std::tuple<const VrmlNode*, const VrmlNode*, bool>, Solid> solids_of_;
  std::size_t depth_ = 0, visits_ = 0, inlines_ = 0, own_kinds_ = 0;
  std::map<std::string, std::size_t> left_out_;  ///< shapes that are no sets of faces, by their type
  PolygonCounts polygon_counts_;
};

}  // namespace

MeshData read_vrml(const Source& source) { return VrmlReader(source).read(); }

}  // namespace holdfast::io
