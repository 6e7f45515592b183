#include "io/dae_geometry.h"

#include <algorithm>

#include "io/polygon.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

class Geometry {
 public:
  Geometry(const DaeFile& file, const Source& source, DaeCounts& counts)
      : file_(file), counts_(counts), mesh_(without_polygons(source)) {}

  Solid read(const DaeElement& mesh, const std::string& name) {
    const DaeElement* const vertices = file_.child(mesh, "vertices");
    if (vertices == nullptr) file_.fail(mesh, "the mesh has no <vertices>");
    read_positions(*vertices);
    for (const DaeElement* part : file_.children(mesh)) read_part(*part);
    counts_.polygons.add(mesh_.polygon_counts);
    Solid solid{name, std::move(mesh_.vertices), std::move(mesh_.facets), std::move(materials_), {}};
    for (std::size_t f = 0; f < solid.facets.size(); ++f)
      solid.facet_material.push_back(static_cast<std::size_t>(mesh_.facet_markers.of(f)));
    return solid;
  }

 private:
  void read_positions(const DaeElement& vertices) {
    const std::vector<const DaeElement*> inputs = file_.children(vertices, "input");
    const auto found = std::find_if(inputs.begin(), inputs.end(), [](const DaeElement* input) {
      return input->tag.attribute("semantic") == "POSITION";
    });
    if (found == inputs.end()) file_.fail(vertices, "the vertices have no positions");
    const DaeElement& source = file_.target(**found, "source");
    const DaeElement* const common = file_.child(source, "technique_common");
    const DaeElement* const accessor = common == nullptr ? nullptr : file_.child(*common, "accessor");
    if (accessor == nullptr) file_.fail(source, "the source has no <accessor>");
    const DaeElement& array = file_.target(*accessor, "source");
    const std::vector<double> values = file_.reals(array);
    const std::uint64_t count = file_.number(*accessor, "count", 0),
                        offset = file_.number(*accessor, "offset", 0),
                        stride = file_.number(*accessor, "stride", 1);
    const bool fits =
        stride >= 3 && offset <= values.size() && count <= (values.size() - offset + stride - 3) / stride;
    if (!fits || count >= no_entity)
      file_.fail(*accessor, std::to_string(count) + " positions, every " + std::to_string(stride) +
                                " numbers, do not fit an array of " + std::to_string(values.size()));
    for (std::size_t i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(offset + i * stride);
      mesh_.vertices.push_back({values[at], values[at + 1], values[at + 2]});
    }
  }

  void read_part(const DaeElement& part) {
    const std::string& kind = part.tag.name;
    if (kind == "lines" || kind == "linestrips") {
      ++counts_.lines;
      return;
    }
    if (kind != "triangles" && kind != "polylist" && kind != "polygons" && kind != "trifans" &&
        kind != "tristrips")
      return;
    material_ = material_of(part);
    stride_ = 1;
    std::optional<std::uint64_t> offset;
    for (const DaeElement* input : file_.children(part, "input")) {
      const std::uint64_t own = file_.number(*input, "offset", 0);
      if (own > kMostInputs) file_.fail(*input, "an offset of " + std::to_string(own));
      stride_ = std::max(stride_, static_cast<std::size_t>(own) + 1);
      if (input->tag.attribute("semantic") == "VERTEX") offset = own;
    }
    if (!offset) file_.fail(part, "<" + kind + "> has no vertices");
    offset_ = static_cast<std::size_t>(*offset);
    if (file_.child(part, "ph") != nullptr)
      file_.fail(part, "polygons with holes are not read; triangulate them");
    if (kind == "polylist") return read_polylist(part);
    for (const DaeElement* list : file_.children(part, "p")) read_list(kind, *list);
  }

  /// From 1; 0: none.
  int material_of(const DaeElement& part) {
    const std::string symbol = part.tag.attribute("material");
    if (symbol.empty()) return 0;
    const DaeElement* const material = file_.find(symbol);
    const std::string name =
        material != nullptr && material->tag.name == "material" ? dae_name(*material) : unescaped(symbol);
    const auto found = std::find(materials_.begin(), materials_.end(), name);
    const auto number = static_cast<int>(found - materials_.begin()) + 1;
    if (found == materials_.end()) materials_.push_back(name);
    return number;
  }

  /// The vertices of a list of indices into all inputs.
  std::vector<Index> corners(const DaeElement& list) const {
    const std::vector<std::uint64_t> all = file_.numbers(list);
    if (all.size() % stride_ != 0)
      file_.fail(list,
                 std::to_string(all.size()) + " numbers are no whole corners of " + std::to_string(stride_));
    std::vector<Index> result;
    for (std::size_t i = offset_; i < all.size(); i += stride_) {
      if (all[i] >= mesh_.vertices.size())
        file_.fail(list, "the vertex " + std::to_string(all[i]) + " is out of range; there are " +
                             std::to_string(mesh_.vertices.size()) + ", and the first is 0");
      result.push_back(static_cast<Index>(all[i]));
    }
    return result;
  }

  void read_polylist(const DaeElement& part) {
    const DaeElement* const counts = file_.child(part, "vcount");
    const DaeElement* const list = file_.child(part, "p");
    if (counts == nullptr || list == nullptr) return;
    const std::vector<Index> all = corners(*list);
    std::size_t next = 0;
    for (const std::uint64_t count : file_.numbers(*counts)) {
      if (count > all.size() - next) file_.fail(*counts, "more corners than the list of vertices has");
      add(*list, std::span(all).subspan(next, static_cast<std::size_t>(count)));
      next += static_cast<std::size_t>(count);
    }
    if (next != all.size()) file_.fail(*counts, "fewer corners than the list of vertices has");
  }

  void read_list(const std::string& kind, const DaeElement& list) {
    const std::vector<Index> all = corners(list);
    if (kind == "polygons") return add(list, all);
    if (kind == "triangles") {
      if (all.size() % 3 != 0)
        file_.fail(list, std::to_string(all.size()) + " corners, which make no triangles");
      for (std::size_t i = 0; i < all.size(); i += 3)
        mesh_.add_facet({all[i], all[i + 1], all[i + 2]}, material_);
    } else if (kind == "tristrips") {
      add_strip(mesh_, all, material_);
    } else {
      for (std::size_t i = 1; i + 1 < all.size(); ++i)
        mesh_.add_facet({all[0], all[i], all[i + 1]}, material_);
    }
  }

  void add(const DaeElement& list, std::span<const Index> polygon) {
    if (polygon.size() < 3) return void(++counts_.lines);
    add_polygon(mesh_, polygon, material_, [&](const std::string& reason) { file_.fail(list, reason); });
  }

  static constexpr std::uint64_t kMostInputs = 1000;

  const DaeFile& file_;
  DaeCounts& counts_;
  MeshData mesh_;  ///< its markers are materials
  std::vector<std::string> materials_;
  int material_ = 0;
  std::size_t stride_ = 1, offset_ = 0;  ///< of the vertices in a list
};

}  // namespace

std::string dae_name(const DaeElement& element) {
  const std::string name = element.tag.attribute("name");
  return unescaped(name.empty() ? element.tag.attribute("id") : name);
}

std::optional<Solid> dae_solid(const DaeFile& file, const Source& source, const DaeElement& geometry,
                               DaeCounts& counts) {
  const DaeElement* const mesh = file.child(geometry, "mesh");
  if (mesh == nullptr) {
    ++counts.others;
    return std::nullopt;
  }
  return Geometry(file, source, counts).read(*mesh, dae_name(geometry));
}

}  // namespace holdfast::io
