// AMF (ISO/ASTM 52915), as XML or packed: objects made of volumes, placed by constellations if there are any.
// Coordinates keep the unit of the file.
#include <algorithm>
#include <array>

#include "io/formats.h"
#include "io/solids.h"
#include "io/text_reader.h"
#include "io/xml_reader.h"
#include "io/zip_archive.h"

namespace holdfast::io {
namespace {

struct AmfObject {
  Solid solid;                           ///< all volumes, with one material each until they are named
  std::vector<std::string> volumes;      ///< names
  std::vector<std::string> material_of;  ///< by volume, its material
};

struct Instance {
  std::string object;
  std::array<double, 3> shift{}, degrees{};
};

/// Rotates about x, then y, then z, then translates.
Placement placement_of(const Instance& instance) {
  Placement result;
  for (std::size_t i = 0; i < 3; ++i) {
    Point axis{};
    axis[i] = 1;
    result = Placement::turned({}, axis, instance.degrees[i]).after(result);
  }
  return Placement::moved_by(instance.shift).after(result);
}

class AmfReader {
 public:
  explicit AmfReader(const Source& source) : source_(source), xml_(source), solids_(source) {}

  MeshData read() {
    bool ended = false;
    while (const std::optional<XmlTag> tag = xml_.next()) {
      beat(source_.watch);
      if (tag->closing) {
        if (tag->name == "amf") ended = true;
        close(tag->name);
      } else if (!tag->empty) {
        open(*tag);
      }
    }
    if (!ended) throw FileError(source_.path, "", "does not end with </amf>; it is truncated or no AMF file");
    put_all();
    MeshData mesh = solids_.take();
    mesh.leave_out(curved_, "normals and edges of curved triangles", "normal or edge of a curved triangle");
    return mesh;
  }

 private:
  void open(const XmlTag& tag) {
    const std::string& name = tag.name;
    path_.push_back(name);
    if (name == "object") {
      order_.push_back(tag.attribute("id"));
      object_ = &objects_[order_.back()];
      if (!object_->volumes.empty()) xml_.fail(tag, "a second object " + in_quotes(order_.back()));
    } else if (name == "volume" && object_ != nullptr) {
      object_->volumes.emplace_back();
      object_->material_of.push_back(tag.attribute("materialid"));
    } else if (name == "material") {
      material_ = tag.attribute("id");
    } else if (name == "instance") {
      instances_.push_back({tag.attribute("objectid"), {}, {}});
    } else if (name == "metadata" && lower(tag.attribute("type")) == "name") {
      take_name(unescaped(xml_.text()));
    } else if (name == "normal" || name == "edge") {
      ++curved_;
    } else {
      read_number(tag);
    }
  }

  void take_name(const std::string& name) {
    const std::string within = path_.size() < 2 ? "" : path_[path_.size() - 2];
    if (within == "object" && object_ != nullptr) object_->solid.name = name;
    if (within == "volume" && object_ != nullptr && !object_->volumes.empty()) object_->volumes.back() = name;
    if (within == "material") materials_[material_] = name;
  }

  void read_number(const XmlTag& tag) {
    const std::string within = path_.size() < 2 ? "" : path_[path_.size() - 2];
    if (within == "coordinates" && tag.name.size() == 1 && tag.name[0] >= 'x' && tag.name[0] <= 'z') {
      point_[static_cast<std::size_t>(tag.name[0] - 'x')] = xml_.real_in_text(tag);
      ++seen_;
    } else if (within == "triangle" && (tag.name == "v1" || tag.name == "v2" || tag.name == "v3")) {
      read_corner(tag, static_cast<std::size_t>(tag.name[1] - '1'));
    } else if (within == "instance") {
      constexpr std::array<std::string_view, 6> kKeys = {"deltax", "deltay", "deltaz", "rx", "ry", "rz"};
      const auto key =
          static_cast<std::size_t>(std::find(kKeys.begin(), kKeys.end(), tag.name) - kKeys.begin());
      if (key < 3) instances_.back().shift[key] = xml_.real_in_text(tag);
      if (key >= 3 && key < 6) instances_.back().degrees[key - 3] = xml_.real_in_text(tag);
    }
  }

  void read_corner(const XmlTag& tag, std::size_t corner) {
    const std::uint64_t vertex = xml_.number_in_text(tag);
    const std::size_t size = object_ == nullptr ? 0 : object_->solid.vertices.size();
    if (vertex >= size)
      xml_.fail(tag, "the vertex " + std::to_string(vertex) + " is out of range; the object has " +
                         std::to_string(size) + ", and the first is 0");
    facet_[corner] = static_cast<Index>(vertex);
    ++seen_;
  }

  void close(const std::string& name) {
    if (!path_.empty() && path_.back() == name) path_.pop_back();
    const bool whole = seen_ == 3;
    if (name == "coordinates" || name == "triangle") seen_ = 0;
    if (object_ == nullptr) return;
    Solid& solid = object_->solid;
    if (name == "object") object_ = nullptr;
    if (name != "coordinates" && name != "triangle") return;
    if (!whole)
      throw FileError(source_.path, "",
                      "<" + name + "> without its three numbers, behind " +
                          std::to_string(solid.vertices.size()) + " vertices and " +
                          std::to_string(solid.facets.size()) + " triangles of an object");
    if (name == "coordinates") {
      solid.vertices.push_back(point_);
    } else {
      solid.facets.push_back(facet_);
      solid.facet_material.push_back(std::max<std::size_t>(object_->volumes.size(), 1));
    }
  }

  /// Volumes are distinguished like the materials of a solid: by their own name or else that of the material.
  void name_volumes(AmfObject& object) {
    for (std::size_t i = 0; i < object.volumes.size(); ++i) {
      const auto found = materials_.find(object.material_of[i]);
      std::string& name = object.volumes[i];
      if (name.empty() && found != materials_.end()) name = found->second;
      if (name.empty() && object.solid.name.empty() && object.volumes.size() > 1)
        name = "volume " + std::to_string(i + 1);
    }
    object.volumes.resize(std::max<std::size_t>(object.volumes.size(), 1));
    object.solid.materials = object.volumes;
  }

  void put_all() {
    for (auto& [id, object] : objects_) name_volumes(object);
    if (instances_.empty())
      for (const std::string& id : order_) instances_.push_back({id, {}, {}});
    for (const Instance& instance : instances_) {
      const auto found = objects_.find(instance.object);
      if (found == objects_.end()) continue;  // a constellation
      solids_.add(found->second.solid, found->second.solid.name, placement_of(instance));
    }
  }

  Source source_;
  XmlReader xml_;
  Solids solids_;
  std::map<std::string, AmfObject> objects_;
  std::vector<std::string> order_;  ///< of the objects in the file
  std::map<std::string, std::string> materials_;
  std::vector<Instance> instances_;
  std::vector<std::string> path_;  ///< names of the open elements
  AmfObject* object_ = nullptr;
  std::string material_;
  Point point_{};
  Triangle facet_{};
  int seen_ = 0;  ///< numbers read of the open point or triangle
  std::size_t curved_ = 0;
};

}  // namespace

MeshData read_amf(const Source& source) {
  if (!is_zip(source.bytes)) return AmfReader(source).read();
  const ZipArchive archive(source);
  for (const auto& [key, entry] : archive.entries()) {
    if (!key.ends_with(".amf")) continue;
    const std::string text = archive.unpacked(entry);
    const std::filesystem::path path = source.path / entry.name;
    return AmfReader({path, text, source.finite, source.watch}).read();
  }
  throw FileError(source.path, "", "the archive holds no .amf file");
}

}  // namespace holdfast::io
