// Reads X3D in XML (ISO/IEC 19776-1) as the scene of VRML97 nodes that it stands for: sets of triangles and
// quadrangles become indexed face sets, and kinds of nodes that are not known become groups. So do the nodes
// of X3D in VRML's syntax (ISO/IEC 19776-2).
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "io/vrml_scene.h"
#include "io/xml_reader.h"
#include "text/parse.h"

namespace holdfast::io {
namespace {

/// Sets of faces, and the corners of each; 0: as in IndexedFaceSet.
struct FaceSet {
  std::string_view type;
  std::size_t corners;
  bool has_index;
};
constexpr FaceSet kFaceSets[] = {{"IndexedFaceSet", 0, true},
                                 {"IndexedTriangleSet", 3, true},
                                 {"IndexedQuadSet", 4, true},
                                 {"TriangleSet", 3, false},
                                 {"QuadSet", 4, false}};

constexpr std::string_view kOtherElements[] = {
    "Transform", "Group",         "Anchor",        "Billboard", "Collision",     "Switch",   "LOD",
    "Shape",     "Inline",        "ProtoInstance", "Box",       "Cone",          "Cylinder", "Sphere",
    "Text",      "ElevationGrid", "Extrusion",     "PointSet",  "IndexedLineSet"};

/// Sets of faces that are left out, as shapes that VRML97 has.
constexpr std::string_view kLeftOut[] = {
    "TriangleStripSet", "TriangleFanSet",    "IndexedTriangleStripSet", "IndexedTriangleFanSet",
    "LineSet",          "NurbsPatchSurface", "NurbsTrimmedSurface",     "GeoElevationGrid"};

constexpr std::string_view kNumbers[] = {
    "point",       "coordIndex", "index",       "translation", "rotation",   "scale",    "scaleOrientation",
    "center",      "size",       "height",      "xDimension",  "zDimension", "xSpacing", "zSpacing",
    "whichChoice", "spine",      "orientation", "crossSection"};
constexpr std::string_view kFlags[] = {"ccw", "beginCap", "endCap"};

template <typename Names>
bool is_one_of(std::string_view name, const Names& names) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

const FaceSet* face_set(std::string_view type) {
  const auto found = std::find_if(std::begin(kFaceSets), std::end(kFaceSets),
                                  [&](const FaceSet& set) { return set.type == type; });
  return found == std::end(kFaceSets) ? nullptr : found;
}

/// The field of a node around it to which a node belongs.
std::string_view field_in(std::string_view around, std::string_view type) {
  if (around == "Shape") return type == "Group" ? "appearance" : "geometry";
  if (type == "Coordinate") return "coord";
  return around == "Switch" ? "choice" : around == "LOD" ? "level" : "children";
}

}  // namespace

std::string VrmlScene::type_in_x3d(const std::string& name) {
  if (face_set(name) != nullptr || is_one_of(name, kOtherElements)) return name;
  if (name == "Coordinate" || name == "CoordinateDouble") return "Coordinate";
  return is_one_of(name, kLeftOut) ? "PointSet" : "Group";
}

void VrmlScene::read_xml() {
  XmlReader xml(source_);
  std::vector<VrmlNode*> open;
  std::vector<std::string> names;  // of the elements that are open
  bool in_scene = false, has_scene = false;
  while (const std::optional<XmlTag> tag = xml.next()) {
    if (tag->name == "Scene") has_scene = in_scene = !tag->closing && !tag->empty;
    if (tag->name == "Scene" && tag->closing) has_scene = true;
    if (!in_scene || tag->name == "Scene") continue;
    if (tag->closing) {
      if (names.empty() || names.back() != tag->name)
        xml.fail(*tag, "the element " + in_quotes(tag->name) + " ends, but is not open");
      close(*open.back());
      open.pop_back();
      names.pop_back();
      continue;
    }
    VrmlNode* const node = open_node(xml, *tag, open.empty() ? nullptr : open.back());
    if (tag->empty) {
      close(*node);
      continue;
    }
    open.push_back(node);
    names.push_back(tag->name);
  }
  if (!has_scene || !open.empty())
    errors_.fail_at(source_.bytes.size(),
                    "the file ends before its scene does; it is truncated or no X3D file");
}

VrmlNode* VrmlScene::open_node(const XmlReader& xml, const XmlTag& tag, VrmlNode* around) {
  VrmlNode& node = nodes_.emplace_back();
  node.type = type_in_x3d(tag.name);
  node.position = tag.position;
  node.name = unescaped(tag.attribute("DEF"));
  const VrmlNode* placed = &node;
  if (const std::string use = unescaped(tag.attribute("USE")); !use.empty()) {
    const auto found = named_.find(use);
    if (found == named_.end()) xml.fail(tag, "USE of " + in_quotes(use) + ", which no DEF before it names");
    placed = found->second;
  } else if (!node.name.empty()) {
    named_[node.name] = &node;
  }
  for (const auto& [name, value] : tag.attributes) {
    beat(source_.watch);
    if (is_one_of(name, kNumbers)) read_numbers(xml, tag, value, node.fields[name]);
    if (is_one_of(name, kFlags)) node.fields[name].word = value == "false" ? "FALSE" : "TRUE";
  }
  const std::string container = tag.attribute("containerField");
  if (around == nullptr)
    roots_.push_back(placed);
  else if (container != "proxy")
    around->fields[std::string(field_in(around->type, node.type))].nodes.push_back(placed);
  return &node;
}

void VrmlScene::read_numbers(const XmlReader& xml, const XmlTag& tag, std::string_view text,
                             VrmlField& field) {
  constexpr std::string_view kBetween = " \t\r\n,";
  for (;;) {
    const std::size_t start = text.find_first_not_of(kBetween);
    if (start == std::string_view::npos) return;
    text.remove_prefix(start);
    const std::string_view word = text.substr(0, text.find_first_of(kBetween));
    double value = 0;
    const auto result = parse_double(word.data(), word.data() + word.size(), value);
    if (result.ec != std::errc() || result.ptr != word.data() + word.size() || !std::isfinite(value))
      xml.fail(tag, "expected a number, found " + in_quotes(word));
    field.numbers.push_back(value);
    text.remove_prefix(word.size());
  }
}

/// Gives a set of triangles or quadrangles the list of faces of an IndexedFaceSet.
void VrmlScene::close(VrmlNode& node) {
  const FaceSet* const set = face_set(node.type);
  if (set == nullptr || set->corners == 0) return;
  node.type = "IndexedFaceSet";
  std::vector<double> corners;
  const std::vector<const VrmlNode*>& coordinates = node.field("coord").nodes;
  if (set->has_index)
    corners = node.field("index").numbers;
  else if (!coordinates.empty())
    for (std::size_t i = 0; i < coordinates[0]->field("point").numbers.size() / 3; ++i)
      corners.push_back(static_cast<double>(i));
  if (corners.size() % set->corners != 0) fail(node, "the corners of the last face are not whole");
  std::vector<double>& faces = node.fields["coordIndex"].numbers;
  faces.clear();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    faces.push_back(corners[i]);
    if ((i + 1) % set->corners == 0) faces.push_back(-1);
  }
}

}  // namespace holdfast::io
