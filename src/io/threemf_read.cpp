// 3MF (3MF Consortium, Core Specification 1.3): the placed items of the build, with parts in other files of
// the package as the production extension (1.1.2) allows. Coordinates keep the unit of the file.
#include <algorithm>
#include <set>

#include "io/formats.h"
#include "io/slicer_volumes.h"
#include "io/solids.h"
#include "io/text_reader.h"
#include "io/xml_reader.h"
#include "io/zip_archive.h"

namespace holdfast::io {
namespace {

constexpr std::string_view kModelRelation = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";

/// A placed reference to another object: a component of an object, or an item of the build.
struct Use {
  std::string part;  ///< the file of the package that contains it
  std::uint64_t object = 0;
  Placement placement;
};

struct Object {
  Solid solid;
  std::vector<Use> components;
  bool used = false;     ///< by another object
  bool is_model = true;  ///< not a support or another object that is not manufactured (section 4.1)
};

using ResourceKey = std::pair<std::string, std::uint64_t>;  ///< part and number

/// A tag or attribute name without its namespace prefix.
std::string_view local(std::string_view name) {
  return name.substr(name.rfind(':') == std::string_view::npos ? 0 : name.rfind(':') + 1);
}

/// What a surface cannot hold: elements of the file, and the paint of slicers in attributes of triangles.
struct LeftOut {
  std::string_view element, many, one;
};
constexpr std::string_view kPaint = "paint";
constexpr LeftOut kLeftOutParts[] = {
    {"ball", "balls of a lattice", "ball of a lattice"},
    {"beam", "beams of a lattice", "beam of a lattice"},
    {"color", "colours", "colour"},
    {"composite", "mixtures of materials", "mixture of materials"},
    {"multi", "combinations of materials, colours or textures",
     "combination of materials, colours or textures"},
    {kPaint, "painted triangles' paint", "painted triangle's paint"},
    {"texture2d", "textures", "texture"},
};

/// The contents of one file of the package.
class Model {
 public:
  Model(const Source& source, std::string part, std::map<ResourceKey, Object>& objects)
      : source_(source), xml_(source), part_(std::move(part)), objects_(objects) {}

  void read() {
    while (const std::optional<XmlTag> tag = xml_.next()) {
      beat(source_.watch);
      if (!tag->closing) read_tag(*tag);
      if (tag->closing && local(tag->name) == "object") object_ = nullptr;
      if (tag->closing && local(tag->name) == "model") return;
    }
    throw FileError(source_.path, "", "does not end with </model>; it is truncated or no 3MF model");
  }

  [[nodiscard]] const std::vector<Use>& items() const { return items_; }
  /// Other parts named by components and items.
  [[nodiscard]] const std::set<std::string>& parts() const { return parts_; }
  /// Elements that describe more than triangles: of the shape or its appearance.
  [[nodiscard]] const std::map<std::string_view, std::size_t>& left_out() const { return left_out_; }

 private:
  void read_tag(const XmlTag& tag) {
    const std::string_view name = local(tag.name);
    if (name == "object")
      begin_object(tag);
    else if (name == "vertex" && object_ != nullptr)
      object_->solid.vertices.push_back({xml_.real(tag, "x"), xml_.real(tag, "y"), xml_.real(tag, "z")});
    else if (name == "triangle" && object_ != nullptr)
      read_triangle(tag);
    else if (name == "component" && object_ != nullptr)
      object_->components.push_back(use_of(tag));
    else if (name == "item")
      items_.push_back(use_of(tag));
    else if (name == "basematerials")
      materials_ = &material_groups_[tag.attribute("id")];
    else if (name == "base" && materials_ != nullptr)
      materials_->push_back(tag.attribute("name"));
    else
      leave_out(name);
  }

  void leave_out(std::string_view element) {
    const auto found = std::find_if(std::begin(kLeftOutParts), std::end(kLeftOutParts),
                                    [&](const LeftOut& l) { return l.element == element; });
    if (found != std::end(kLeftOutParts)) ++left_out_[found->element];
  }

  void begin_object(const XmlTag& tag) {
    const std::uint64_t id = xml_.number(tag, "id");
    const auto [there, fresh] = objects_.try_emplace({part_, id});
    if (!fresh) xml_.fail(tag, "a second object " + std::to_string(id));
    object_ = tag.empty ? nullptr : &there->second;
    there->second.solid.name = tag.attribute("name");
    const std::string type = tag.attribute("type");
    there->second.is_model = type.empty() || type == "model" || type == "surface";
    object_group_ = tag.attribute("pid");
    object_material_ = material_of(object_group_, tag.attribute("pindex"), there->second.solid);
  }

  void read_triangle(const XmlTag& tag) {
    Solid& solid = object_->solid;
    Triangle facet{};
    constexpr std::string_view kCorners[] = {"v1", "v2", "v3"};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint64_t corner = xml_.number(tag, kCorners[i]);
      if (corner >= solid.vertices.size())
        xml_.fail(tag, "the vertex " + std::to_string(corner) + " is out of range; the object has " +
                           std::to_string(solid.vertices.size()) + ", and the first is 0");
      facet[i] = static_cast<Index>(corner);
    }
    const std::string group = tag.attribute("pid"), first = tag.attribute("p1");
    const std::size_t own =
        group.empty() && first.empty() ? 0 : material_of(group.empty() ? object_group_ : group, first, solid);
    const std::size_t material = own != 0 ? own : object_material_;
    if (material != 0) {
      solid.facet_material.resize(solid.facets.size(), 0);
      solid.facet_material.push_back(material);
    } else if (!solid.facet_material.empty()) {
      solid.facet_material.push_back(0);
    }
    solid.facets.push_back(facet);
    if (std::any_of(tag.attributes.begin(), tag.attributes.end(), [](const auto& attribute) {
          const std::string_view name = local(attribute.first);
          return name == "mmu_segmentation" || name == "paint_color";
        }))
      ++left_out_[kPaint];
  }

  /// The number, from 1, of a group's material in a solid; 0 if the group has colours or the like.
  std::size_t material_of(const std::string& group, const std::string& index, Solid& solid) {
    const auto found = material_groups_.find(group);
    if (found == material_groups_.end()) return 0;
    const std::vector<std::string>& names = found->second;
    const std::string digits = index.empty() ? "0" : index;
    if (digits.size() > 9 || digits.find_first_not_of("0123456789") != std::string::npos) return 0;
    const auto number = static_cast<std::size_t>(std::stoul(digits));
    if (number >= names.size()) return 0;
    const auto there = std::find(solid.materials.begin(), solid.materials.end(), names[number]);
    if (there != solid.materials.end()) return static_cast<std::size_t>(there - solid.materials.begin()) + 1;
    solid.materials.push_back(names[number]);
    return solid.materials.size();
  }

  Use use_of(const XmlTag& tag) {
    Use use;
    use.object = xml_.number(tag, "objectid");
    use.part = part_;
    for (const auto& [name, value] : tag.attributes)
      if (name.ends_with(":path")) use.part = ZipArchive::key_of(value);
    if (use.part != part_) parts_.insert(use.part);
    if (!tag.attribute("transform").empty()) {
      const std::vector<double> values = xml_.reals(tag, "transform", 12);
      std::copy(values.begin(), values.end(), use.placement.m.begin());
    }
    return use;
  }

  Source source_;
  XmlReader xml_;
  std::string part_;
  std::map<ResourceKey, Object>& objects_;
  Object* object_ = nullptr;
  std::map<std::string, std::vector<std::string>> material_groups_;
  std::vector<std::string>* materials_ = nullptr;
  std::string object_group_;  ///< material group of triangles that name none
  std::size_t object_material_ = 0;
  std::vector<Use> items_;
  std::set<std::string> parts_;
  std::map<std::string_view, std::size_t> left_out_;
};

class Package {
 public:
  explicit Package(const Source& source) : source_(source), archive_(source), solids_(source) {}

  MeshData read() {
    std::vector<Use> items = read_models();
    take_slicer_volumes();
    if (items.empty()) items = what_no_object_uses();
    for (const Use& item : items) put(item, {}, "");
    MeshData mesh = solids_.take();
    for (const LeftOut& l : kLeftOutParts) mesh.leave_out(left_out_[l.element], l.many, l.one);
    mesh.leave_out(no_models_, "supports and other objects that are no part of the model",
                   "support or other object that is no part of the model");
    mesh.leave_out(no_material_, "volumes that modify the print", "volume that modifies the print");
    return mesh;
  }

 private:
  /// Takes names and kinds of volumes, which count as materials of their object.
  void take_slicer_volumes() {
    const ZipArchive::Entry* const entry = archive_.find(kSlicerVolumes);
    if (entry == nullptr) return;
    const std::string text = archive_.unpacked(*entry);
    const std::filesystem::path path = source_.path / entry->name;
    for (const auto& [id, told] : read_slicer_volumes({path, text, false, source_.watch}))
      if (const auto found = objects_.find({root_, id}); found != objects_.end())
        divide(found->second.solid, told);
  }

  /// Volumes that do not cover the triangles once, in order, as after a change by another program, are
  /// ignored.
  void divide(Solid& solid, const SlicerObject& told) {
    std::uint64_t next = 0;
    for (const SlicerVolume& volume : told.volumes) {
      if (volume.first != next || volume.last < volume.first || volume.last >= solid.facets.size()) return;
      next = volume.last + 1;
    }
    if (next != solid.facets.size()) return;
    if (solid.name.empty()) solid.name = told.name;
    std::vector<Triangle> kept;
    std::vector<std::size_t> materials;
    solid.materials.clear();
    for (const SlicerVolume& volume : told.volumes) {
      if (!volume.is_material()) {
        ++no_material_;
        continue;
      }
      solid.materials.push_back(volume.name);
      const auto begin = solid.facets.begin() + static_cast<std::ptrdiff_t>(volume.first);
      kept.insert(kept.end(), begin, begin + static_cast<std::ptrdiff_t>(volume.last - volume.first + 1));
      materials.resize(kept.size(), solid.materials.size());
    }
    if (kept.size() < solid.facets.size()) keep_vertices_of(kept, solid.vertices);
    solid.facets = std::move(kept);
    solid.facet_material = std::move(materials);
  }

  static void keep_vertices_of(std::vector<Triangle>& facets, std::vector<Point>& vertices) {
    std::vector<Index> place(vertices.size(), no_entity);
    std::vector<Point> kept;
    for (Triangle& facet : facets)
      for (Index& corner : facet) {
        if (place[corner] == no_entity) {
          place[corner] = static_cast<Index>(kept.size());
          kept.push_back(vertices[corner]);
        }
        corner = place[corner];
      }
    vertices = std::move(kept);
  }

  /// The root part, named by the package's relations.
  std::string root_part() const {
    if (const ZipArchive::Entry* relations = archive_.find("_rels/.rels")) {
      const std::string text = archive_.unpacked(*relations);
      const std::filesystem::path path = source_.path / relations->name;
      XmlReader xml({path, text, false, source_.watch});
      while (const std::optional<XmlTag> tag = xml.next())
        if (tag->attribute("Type") == kModelRelation) return ZipArchive::key_of(tag->attribute("Target"));
    }
    for (const auto& [name, entry] : archive_.entries())
      if (name.ends_with(".model")) return name;
    throw FileError(source_.path, "", "the archive holds no 3MF model");
  }

  /// Reads all named parts; returns the items of the root.
  std::vector<Use> read_models() {
    std::vector<Use> items;
    std::vector<std::string> waiting{root_part()};
    std::set<std::string> read;
    while (!waiting.empty()) {
      const std::string part = waiting.back();
      waiting.pop_back();
      if (!read.insert(part).second) continue;
      const ZipArchive::Entry* const entry = archive_.find(part);
      if (entry == nullptr)
        throw FileError(source_.path, "", "the package has no " + in_quotes(part) + ", which it names");
      const std::string text = archive_.unpacked(*entry);
      const std::filesystem::path path = source_.path / entry->name;
      Model model({path, text, source_.finite, source_.watch}, part, objects_);
      model.read();
      if (read.size() == 1) {
        items = model.items();
        root_ = part;
      }
      waiting.insert(waiting.end(), model.parts().begin(), model.parts().end());
      for (const auto& [what, count] : model.left_out()) left_out_[what] += count;
    }
    return items;
  }

  /// Without a build, all objects that no other object uses are the items.
  std::vector<Use> what_no_object_uses() {
    for (const auto& [key, object] : objects_)
      for (const Use& use : object.components)
        if (const auto found = objects_.find({use.part, use.object}); found != objects_.end())
          found->second.used = true;
    std::vector<Use> uses;
    for (const auto& [key, object] : objects_)
      if (!object.used) uses.push_back({key.first, key.second, {}});
    return uses;
  }

  void put(const Use& use, const Placement& outer, const std::string& outer_name) {
    step(source_.watch);
    const auto found = objects_.find({use.part, use.object});
    const std::string what = "object " + std::to_string(use.object) + " of " + in_quotes(use.part);
    if (found == objects_.end())
      throw FileError(source_.path, "", "the package has no " + what + ", which it names");
    const ResourceKey key = found->first;
    if (std::find(open_.begin(), open_.end(), key) != open_.end())
      throw FileError(source_.path, "", what + " is a component of itself");
    if (open_.size() > kDeepest || ++uses_ > kMostUses)
      throw FileError(source_.path, "", "components of components without end, as " + what);
    const Object& object = found->second;
    if (!object.is_model) {
      ++no_models_;
      return;
    }
    open_.push_back(key);
    const Placement placement = outer == Placement{} ? use.placement : outer.after(use.placement);
    const std::string& name = object.solid.name.empty() ? outer_name : object.solid.name;
    if (!object.solid.facets.empty()) solids_.add(object.solid, name, placement);
    for (const Use& component : object.components) put(component, placement, name);
    open_.pop_back();
  }

  static constexpr std::size_t kDeepest = 64, kMostUses = std::size_t{1} << 21;
  Source source_;
  ZipArchive archive_;
  std::map<ResourceKey, Object> objects_;
  std::map<std::string_view, std::size_t> left_out_;
  std::size_t no_material_ = 0;  ///< volumes without material
  std::size_t no_models_ = 0;    ///< copies of objects that are no models
  std::string root_;             ///< the part with the build
  Solids solids_;
  std::vector<ResourceKey> open_;  ///< objects whose components are being placed
  std::size_t uses_ = 0;
};

}  // namespace

MeshData read_3mf(const Source& source) {
  if (!is_zip(source.bytes)) throw FileError(source.path, "", "is no 3MF package, which is a ZIP archive");
  return Package(source).read();
}

}  // namespace holdfast::io
