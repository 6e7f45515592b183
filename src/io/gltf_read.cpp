// glTF (Khronos, glTF 2.0), as JSON with buffers beside or in it, and binary: the meshes of the scene, placed
// by its nodes. Axes and unit are those of the file.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "io/formats.h"
#include "io/gltf_file.h"
#include "io/named_files.h"
#include "io/solids.h"
#include "io/text_reader.h"
#include "text/decimal.h"

namespace holdfast::io {
namespace {

/// Extensions that change only appearance, or storage in a way that is supported.
constexpr std::string_view kHarmless[] = {"KHR_materials_",        "KHR_texture_", "EXT_texture_",
                                          "KHR_lights_",           "KHR_xmp",      "MSFT_texture_",
                                          "KHR_mesh_quantization", "EXT_lights_",  "KHR_animation_"};
constexpr std::string_view kDraco = "KHR_draco_mesh_compression", kInstances = "EXT_mesh_gpu_instancing";

enum class Mode : std::uint64_t { points, lines, line_loop, line_strip, triangles, strip, fan };

/// x' = x m[0] + y m[4] + z m[8] + m[12], and so on.
Placement placement_of(const std::vector<double>& m) {
  return {{m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10], m[12], m[13], m[14]}};
}

/// Scales, rotates by a unit quaternion, and translates.
Placement placement_of(const std::vector<double>& move, const std::vector<double>& q,
                       const std::vector<double>& scale) {
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  return {{(1 - 2 * (y * y + z * z)) * scale[0], 2 * (x * y + z * w) * scale[0],
           2 * (x * z - y * w) * scale[0], 2 * (x * y - z * w) * scale[1],
           (1 - 2 * (x * x + z * z)) * scale[1], 2 * (y * z + x * w) * scale[1],
           2 * (x * z + y * w) * scale[2], 2 * (y * z - x * w) * scale[2],
           (1 - 2 * (x * x + y * y)) * scale[2], move[0], move[1], move[2]}};
}

class GltfReader {
 public:
  explicit GltfReader(const Source& source) : source_(source), file_(source), solids_(source) {}

  MeshData read() {
    require_known_extensions();
    meshes_.resize(file_.list(file_.root(), "meshes").size());
    put_scene();
    MeshData mesh = solids_.take();
    tell(mesh);
    return mesh;
  }

 private:
  void require_known_extensions() const {
    for (const Json& extension : file_.list(file_.root(), "extensionsRequired")) {
      const std::string name = shown(extension);
      if (std::none_of(std::begin(kHarmless), std::end(kHarmless),
                       [&](std::string_view known) { return name.starts_with(known); }))
        file_.fail(extension, "the file needs the extension " + in_quotes(name) +
                                  ", which is not read; save it without" +
                                  (name == kDraco || name.ends_with("compression") ? " compression" : ""));
    }
  }

  // --- The scene ---------------------------------------------------------------------------------------

  /// A node to visit, with the placement of its parent.
  struct Waiting {
    std::size_t node;
    Placement outer;
  };

  void put_scene() {
    const auto nodes = file_.list(file_.root(), "nodes");
    std::vector<Waiting> waiting;
    for (const std::size_t root : roots()) waiting.push_back({root, {}});
    std::reverse(waiting.begin(), waiting.end());
    std::vector<std::uint8_t> is_put(nodes.size(), 0);
    while (!waiting.empty()) {
      const auto [n, outer] = waiting.back();
      waiting.pop_back();
      step(source_.watch);
      const Json& node = nodes[n];
      if (std::exchange(is_put[n], std::uint8_t{1}) != 0)
        file_.fail(node, "node " + std::to_string(n) + " is a child of two nodes, or of itself");
      const Placement own = placement(node);
      const Placement here = outer == Placement{} ? own : outer.after(own);
      put_mesh(node, here);
      const auto children = file_.list(node, "children");
      for (auto child = children.rbegin(); child != children.rend(); ++child)
        waiting.push_back({file_.entry_of(*child, "nodes"), here});
    }
    if (nodes.empty())  // a library of meshes
      for (std::size_t m = 0; m < meshes_.size(); ++m) put(m, "", {});
  }

  /// The roots of the default scene; without scenes, all nodes that are no children.
  [[nodiscard]] std::vector<std::size_t> roots() const {
    const auto scenes = file_.list(file_.root(), "scenes");
    std::vector<std::size_t> roots;
    if (!scenes.empty()) {
      const std::size_t shown = file_.entry(file_.root(), "scene", "scenes").value_or(0);
      for (const Json& node : file_.list(scenes[shown], "nodes"))
        roots.push_back(file_.entry_of(node, "nodes"));
      return roots;
    }
    const auto nodes = file_.list(file_.root(), "nodes");
    std::vector<std::uint8_t> is_child(nodes.size(), 0);
    for (const Json& node : nodes)
      for (const Json& child : file_.list(node, "children")) is_child[file_.entry_of(child, "nodes")] = 1;
    for (std::size_t n = 0; n < nodes.size(); ++n)
      if (is_child[n] == 0) roots.push_back(n);
    return roots;
  }

  [[nodiscard]] Placement placement(const Json& node) const {
    if (const auto matrix = file_.reals(node, "matrix", 16)) return placement_of(*matrix);
    return placement_of(file_.reals(node, "translation", 3).value_or(std::vector<double>{0, 0, 0}),
                        file_.reals(node, "rotation", 4).value_or(std::vector<double>{0, 0, 0, 1}),
                        file_.reals(node, "scale", 3).value_or(std::vector<double>{1, 1, 1}));
  }

  void put_mesh(const Json& node, const Placement& here) {
    const std::optional<std::size_t> m = file_.entry(node, "mesh", "meshes");
    if (!m) return;
    if (const Json* extensions = member(node, "extensions"))
      instances_ += member(*extensions, kInstances) != nullptr ? 1 : 0;
    put(*m, GltfFile::name(node), here);
  }

  void put(std::size_t m, const std::string& name, const Placement& here) {
    if (!meshes_[m]) meshes_[m] = solid_of(m);
    const Solid& solid = *meshes_[m];
    solids_.set_bytes(file_.bytes());
    if (!solid.facets.empty()) solids_.add(solid, name.empty() ? solid.name : name, here);
  }

  // --- Meshes ------------------------------------------------------------------------------------------

  Solid solid_of(std::size_t m) {
    const Json& mesh = file_.list(file_.root(), "meshes")[m];
    Solid solid;
    solid.name = GltfFile::name(mesh);
    std::map<std::size_t, Index> first_of;  // by accessor of positions
    std::map<std::size_t, std::size_t> material_of;
    for (const Json& primitive : file_.list(mesh, "primitives")) {
      step(source_.watch);
      read_primitive(primitive, first_of, solid);
      const std::optional<std::size_t> material = file_.entry(primitive, "material", "materials");
      std::size_t number = 0;
      if (material) {
        const auto [found, is_new] = material_of.try_emplace(*material, solid.materials.size() + 1);
        if (is_new) solid.materials.push_back(material_name(*material));
        number = found->second;
      }
      solid.facet_material.resize(solid.facets.size(), number);
    }
    return solid;
  }

  [[nodiscard]] std::string material_name(std::size_t material) const {
    const std::string name = GltfFile::name(file_.list(file_.root(), "materials")[material]);
    return name.empty() ? "material " + std::to_string(material) : name;
  }

  /// Primitives may share their numbers, so the mesh can grow with the square of the file's length. In an
  /// honest file, a vertex or a corner takes at least a byte.
  void refuse_a_trap(const Json& primitive, std::size_t more) {
    constexpr std::size_t kHarmless = std::size_t{1} << 22, kMostTimes = 4;
    read_ += more;
    if (read_ > kHarmless && read_ / kMostTimes > file_.bytes())
      file_.fail(primitive,
                 "the file has more than " + std::to_string(read_) +
                     " vertices and corners of the same numbers; such a file is damaged or malicious");
  }

  void read_primitive(const Json& primitive, std::map<std::size_t, Index>& first_of, Solid& solid) {
    const Json* const attributes = member(primitive, "attributes");
    if (attributes == nullptr || !attributes->is_object())
      file_.fail(primitive, "the primitive has no attributes");
    for (const auto& [key, accessor] : attributes->items())
      if (key != "POSITION") attributes_.insert(key);
    const std::optional<Mode> mode = mode_of(primitive);
    if (!mode) return;
    targets_ += file_.list(primitive, "targets").size();
    const std::optional<std::size_t> positions = file_.entry(*attributes, "POSITION", "accessors");
    if (!positions) {
      ++without_positions_;
      return;
    }
    if (const Json* extensions = member(primitive, "extensions");
        extensions != nullptr && member(*extensions, kDraco) != nullptr && !file_.has_values(*positions))
      file_.fail(primitive, "the mesh is compressed by " + std::string(kDraco) +
                                ", which is not read; save it without compression");
    const auto [found, is_new] = first_of.try_emplace(*positions, static_cast<Index>(solid.vertices.size()));
    if (is_new) add_vertices(*positions, primitive, solid);
    add_triangles(primitive, *mode, corners(primitive, count_of_[*positions], found->second), solid);
  }

  void add_vertices(std::size_t accessor, const Json& primitive, Solid& solid) {
    const std::vector<double> values = file_.values(accessor, 3);
    if (solid.vertices.size() + values.size() / 3 >= no_entity)
      file_.fail(primitive, "the mesh has more vertices than 32 bits count");
    for (std::size_t i = 0; i < values.size(); i += 3)
      solid.vertices.push_back({values[i], values[i + 1], values[i + 2]});
    count_of_[accessor] = values.size() / 3;
    refuse_a_trap(primitive, values.size() / 3);
  }

  std::vector<Index> corners(const Json& primitive, std::size_t vertices, Index first) {
    std::vector<Index> corners;
    if (const auto indices = file_.entry(primitive, "indices", "accessors")) {
      const std::vector<double> values = file_.values(*indices, 1);
      corners.reserve(values.size());
      for (const double value : values) {
        if (!(value >= 0 && value < static_cast<double>(vertices)) || value != std::floor(value))
          file_.fail(primitive, "the vertex " + decimal(value) + " is out of range; the primitive has " +
                                    std::to_string(vertices) + ", and the first is 0");
        corners.push_back(first + static_cast<Index>(value));
      }
    } else {
      corners.resize(vertices);
      for (std::size_t i = 0; i < vertices; ++i) corners[i] = first + static_cast<Index>(i);
    }
    refuse_a_trap(primitive, corners.size());
    return corners;
  }

  /// Returns nullopt, and counts the primitive, if it has no triangles.
  std::optional<Mode> mode_of(const Json& primitive) {
    const std::uint64_t number = file_.number(primitive, "mode").value_or(4);
    if (number > 6) file_.fail(primitive, "the mode " + std::to_string(number) + " is none");
    const Mode mode = static_cast<Mode>(number);
    if (mode >= Mode::triangles) return mode;
    ++(mode == Mode::points ? points_ : lines_);
    return std::nullopt;
  }

  void add_triangles(const Json& primitive, Mode mode, std::span<const Index> v, Solid& solid) {
    if (v.size() < 3 || (mode == Mode::triangles && v.size() % 3 != 0))
      file_.fail(primitive, std::to_string(v.size()) + " corners, which make no triangles");
    const std::size_t next = mode == Mode::triangles ? 3 : 1;
    for (std::size_t i = 0; i + 2 < v.size(); i += next) {
      beat(source_.watch);
      Triangle t{v[i], v[i + 1], v[i + 2]};
      if (mode == Mode::fan) t = {v[0], v[i + 1], v[i + 2]};
      if (mode == Mode::strip && i % 2 == 1) std::swap(t[0], t[1]);
      // Degenerate triangles join strips.
      if (mode == Mode::strip && (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])) continue;
      solid.facets.push_back(t);
    }
  }

  // --- Skipped content ---------------------------------------------------------------------------------

  void tell(MeshData& mesh) const {
    std::string names;
    for (const std::string& name : attributes_) names += (names.empty() ? "" : ", ") + name;
    mesh.leave_out(attributes_.size(), "attributes of vertices (" + names + ")",
                   "attribute of vertices (" + names + ")");
    mesh.leave_out(file_.list(file_.root(), "textures").size(), "textures", "texture");
    mesh.leave_out(file_.list(file_.root(), "skins").size(), "skins, with the poses of their meshes",
                   "skin, with the pose of its meshes");
    mesh.leave_out(targets_, "morph targets", "morph target");
    mesh.leave_out(file_.list(file_.root(), "animations").size(), "animations", "animation");
    mesh.leave_out(points_, "primitives of points", "primitive of points");
    mesh.leave_out(lines_, "primitives of lines", "primitive of lines");
    mesh.leave_out(without_positions_, "primitives without positions", "primitive without positions");
    mesh.leave_out(instances_, "nodes' instances, but one,", "node's instances, but one,");
    const auto hidden = static_cast<std::size_t>(
        std::count_if(meshes_.begin(), meshes_.end(), [](const auto& m) { return !m.has_value(); }));
    mesh.leave_out(hidden, "meshes that are not in the scene", "mesh that is not in the scene");
    mesh.leave_out(file_.behind(), "bytes after the file's end", "byte after the file's end");
  }

  Source source_;
  GltfFile file_;
  Solids solids_;
  std::vector<std::optional<Solid>> meshes_;     ///< meshes that are used
  std::map<std::size_t, std::size_t> count_of_;  ///< vertices, by accessor
  std::set<std::string> attributes_;
  std::size_t read_ = 0;  ///< vertices and corners
  std::size_t targets_ = 0, points_ = 0, lines_ = 0, without_positions_ = 0, instances_ = 0;
};

}  // namespace

MeshData read_gltf(const Source& source) { return GltfReader(source).read(); }

std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& path) {
  return with_named_files(path, [](const Source& source) { return GltfFile(source).files_beside(); });
}

}  // namespace holdfast::io
