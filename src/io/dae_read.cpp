// Reads COLLADA, .dae (COLLADA 1.4.1 and 1.5): the meshes of the scene, one copy for each node that places
// them. Axes and the unit stay as they are.
#include <cmath>
#include <map>
#include <optional>

#include "io/dae_geometry.h"
#include "io/formats.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

class DaeReader {
 public:
  explicit DaeReader(const Source& source) : source_(source), file_(source), solids_(source) {}

  MeshData read() {
    if (const DaeElement* scene = visual_scene()) {
      for (const DaeElement* node : file_.children(*scene, "node")) visit(*node, {}, 0);
    } else {
      for (const DaeElement* library : file_.children(file_.root(), "library_geometries"))
        for (const DaeElement* geometry : file_.children(*library, "geometry")) put(*geometry, "", {});
    }
    MeshData mesh = solids_.take();
    mesh.polygon_counts = counts_.polygons;
    mesh.leave_out(counts_.lines, "lists of lines", "list of lines");
    mesh.leave_out(counts_.others, "geometries that are no meshes", "geometry that is no mesh");
    mesh.leave_out(skins_, "skins and morphs, with the poses of their meshes",
                   "skin or morph, with the pose of its mesh");
    return mesh;
  }

 private:
  static constexpr std::size_t kDeepest = 256, kMostVisits = std::size_t{1} << 21;

  /// The scene that the file shows, or else the first one.
  const DaeElement* visual_scene() {
    if (const DaeElement* scene = file_.child(file_.root(), "scene"))
      if (const DaeElement* instance = file_.child(*scene, "instance_visual_scene"))
        return &file_.target(*instance, "url");
    if (const DaeElement* library = file_.child(file_.root(), "library_visual_scenes"))
      return file_.child(*library, "visual_scene");
    return nullptr;
  }

  void visit(const DaeElement& node, Placement placement, std::size_t depth) {
    if (depth == kDeepest) file_.fail(node, "nodes stand more than " + std::to_string(kDeepest) + " deep");
    if (++visits_ > kMostVisits)
      file_.fail(node, "nodes are used more than " + std::to_string(kMostVisits) +
                           " times; such a file is damaged or malicious");
    step(source_.watch);
    for (const DaeElement* child : file_.children(node)) {
      const std::string& kind = child->tag.name;
      if (kind == "node")
        visit(*child, placement, depth + 1);
      else if (kind == "instance_node")
        visit(file_.target(*child, "url"), placement, depth + 1);
      else if (kind == "instance_geometry")
        put(file_.target(*child, "url"), dae_name(node), placement);
      else if (kind == "instance_controller")
        put_skin(file_.target(*child, "url"), dae_name(node), placement);
      else
        placement = placement.after(transform(*child));
    }
  }

  std::vector<double> reals(const DaeElement& element, std::size_t count) const {
    std::vector<double> values = file_.reals(element);
    if (values.size() != count)
      file_.fail(element, "<" + element.tag.name + "> has " + std::to_string(values.size()) +
                              " numbers instead of " + std::to_string(count));
    return values;
  }

  /// Of an element of a node; no transform if it is something else.
  Placement transform(const DaeElement& element) const {
    const std::string& kind = element.tag.name;
    Placement result;
    if (kind == "translate") {
      const std::vector<double> v = reals(element, 3);
      return Placement::moved_by({v[0], v[1], v[2]});
    }
    if (kind == "rotate") {
      const std::vector<double> v = reals(element, 4);
      const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
      if (v[3] == 0) return result;
      if (!(length > 0)) file_.fail(element, "a rotation without an axis");
      return Placement::turned({}, {v[0] / length, v[1] / length, v[2] / length}, v[3]);
    }
    if (kind == "scale") {
      const std::vector<double> v = reals(element, 3);
      for (std::size_t axis = 0; axis < 3; ++axis) result.m[4 * axis] = v[axis];
      return result;
    }
    if (kind == "matrix") return of_matrix(reals(element, 16));
    if (kind == "lookat" || kind == "skew")
      file_.fail(element, "<" + kind + "> is not read; save the node with a matrix");
    return result;
  }

  /// Of a matrix row by row, for columns.
  static Placement of_matrix(const std::vector<double>& v) {
    Placement result;
    for (std::size_t column = 0; column < 4; ++column)
      for (std::size_t axis = 0; axis < 3; ++axis) result.m[3 * column + axis] = v[4 * axis + column];
    return result;
  }

  void put(const DaeElement& geometry, const std::string& name, const Placement& placement) {
    if (geometry.tag.name != "geometry")
      file_.fail(geometry, "expected a <geometry>, found <" + geometry.tag.name + ">");
    const auto [found, is_new] = solids_of_.try_emplace(&geometry);
    if (is_new) found->second = dae_solid(file_, source_, geometry, counts_);
    if (found->second) solids_.add(*found->second, name.empty() ? found->second->name : name, placement);
  }

  /// The geometry of a skin or morph, as it is before any pose.
  void put_skin(const DaeElement& controller, const std::string& name, const Placement& placement) {
    ++skins_;
    Placement shape = placement;
    const DaeElement* around = &controller;
    for (std::size_t depth = 0; around->tag.name == "controller"; ++depth) {
      const DaeElement* skin = file_.child(*around, "skin");
      if (skin == nullptr) skin = file_.child(*around, "morph");
      if (skin == nullptr || depth == kDeepest) file_.fail(*around, "a controller without skin or morph");
      if (const DaeElement* bind = file_.child(*skin, "bind_shape_matrix"))
        shape = shape.after(of_matrix(reals(*bind, 16)));
      around = &file_.target(*skin, "source");
    }
    put(*around, name, shape);
  }

  Source source_;
  DaeFile file_;
  Solids solids_;
  DaeCounts counts_;
  std::map<const DaeElement*, std::optional<Solid>> solids_of_;  ///< of the geometries in use
  std::size_t visits_ = 0, skins_ = 0;
};

}  // namespace

MeshData read_dae(const Source& source) { return DaeReader(source).read(); }

}  // namespace holdfast::io
