#include "io/slicer_volumes.h"

#include "io/xml_reader.h"

namespace holdfast::io {

std::map<std::uint64_t, SlicerObject> read_slicer_volumes(const Source& source) {
  std::map<std::uint64_t, SlicerObject> objects;
  SlicerObject* object = nullptr;
  XmlReader xml(source);
  while (const std::optional<XmlTag> tag = xml.next()) {
    if (tag->closing) continue;
    if (tag->name == "object") {
      object = &objects[xml.number(*tag, "id")];
    } else if (tag->name == "volume" && object != nullptr) {
      object->volumes.push_back({xml.number(*tag, "firstid"), xml.number(*tag, "lastid"), {}});
    } else if (tag->name == "metadata" && object != nullptr) {
      const std::string type = tag->attribute("type"), key = tag->attribute("key"),
                        value = tag->attribute("value");
      if (type == "object" && key == "name") object->name = value;
      if (type != "volume" || object->volumes.empty()) continue;
      SlicerVolume& volume = object->volumes.back();
      if (key == "name") volume.name = value;
      if (key == "volume_type") volume.kind = value;
      if (key == "modifier" && value == "1") volume.kind = "ParameterModifier";  // of before 2019
    }
  }
  return objects;
}

}  // namespace holdfast::io
