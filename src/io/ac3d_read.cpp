// AC3D's .ac and .acc, which FlightGear and TORCS use: the polygons and triangle strips of the tree of
// objects, each object a solid. Axes and the unit stay as they are (Inivis, "The AC3D file format").
#include "io/ac3d_read.h"

#include <algorithm>
#include <charconv>
#include <map>

#include "io/polygon.h"
#include "io/solids.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

/// A name with or without quotes, which may hold blanks.
std::string_view unquoted(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  text.remove_prefix(first);
  if (text[0] != '"') return text.substr(0, text.find_first_of(" \t"));
  return text.substr(1, text.find('"', 1) - 1);
}

class Ac3dReader {
 public:
  explicit Ac3dReader(const Source& source) : source_(source), text_(source, '\0'), solids_(source) {}

  MeshData read() {
    if (!text_.word("AC3D's first line").starts_with("AC3D"))
      text_.fail("expected AC3D's first line, which begins with AC3D");
    text_.skip_line();
    while (!text_.at_end()) read_statement();
    MeshData mesh = solids_.take();
    if (!open_.empty())  // TORCS' own tools write such numbers
      mesh.remarks.push_back(
          {RemarkKind::left_out, 1,
           "the file ends before all objects that 'kids' announces: triangles may be missing"});
    mesh.polygon_counts = counts_;
    mesh.leave_out(unused_, "points of no face", "point of no face");
    mesh.leave_out(lines_, "lines", "line");
    mesh.leave_out(
        unknown_, [](const std::string& name) { return in_quotes(name); }, "unknown statements",
        "unknown statement");
    return mesh;
  }

 private:
  static constexpr std::size_t kDeepest = 256;
  enum Kind : std::uint64_t { kPolygon = 0, kClosedLine = 1, kOpenLine = 2, kStrip = 4 };

  struct Object {
    std::string name;
    Placement own;  ///< rotation and shift
    MeshData mesh;  ///< its markers are materials, from 1
    std::size_t kids = 0;
  };

  void read_statement() {
    const std::string_view keyword = text_.word_on_line();
    if (keyword == "MATERIAL" || keyword == "MAT")
      materials_.emplace_back(unquoted(text_.rest_of_line()));
    else if (keyword == "OBJECT")
      begin_object();
    else if (open_.empty())
      read_of_material(keyword);
    else
      read_of_object(keyword, open_.back());
  }

  /// Of the newer form of a material, which ends with ENDMAT.
  void read_of_material(std::string_view keyword) {
    static constexpr std::string_view kKnown[] = {"rgb", "amb",   "emis", "spec",
                                                  "shi", "trans", "data", "ENDMAT"};
    if (std::find(std::begin(kKnown), std::end(kKnown), keyword) == std::end(kKnown) || materials_.empty())
      text_.fail("expected MATERIAL or OBJECT, found " + in_quotes(keyword));
    if (keyword == "data") return skip_data();
    text_.skip_line();
  }

  void begin_object() {
    step(source_.watch);
    if (open_.size() == kDeepest) text_.fail("objects stand more than " + std::to_string(kDeepest) + " deep");
    open_.emplace_back().mesh = MeshData(source_);
    text_.skip_line();
  }

  void read_of_object(std::string_view keyword, Object& object) {
    static constexpr std::string_view kLooks[] = {"texture", "texrep", "texoff", "url",    "crease",
                                                  "subdiv",  "hidden", "locked", "folded", "shader"};
    if (keyword == "name") {
      object.name = unquoted(text_.rest_of_line());
    } else if (keyword == "data") {
      skip_data();
    } else if (keyword == "rot") {
      for (std::size_t i = 0; i < 9; ++i) object.own.m[i] = text_.real("a number of a rotation");
      text_.skip_line();
    } else if (keyword == "loc") {
      const Point shift = text_.point();
      for (std::size_t axis = 0; axis < 3; ++axis) object.own.m[9 + axis] = shift[axis];
      text_.skip_line();
    } else if (keyword == "numvert") {
      read_vertices(object.mesh);
    } else if (keyword == "numsurf") {
      const std::size_t count = text_.count("the number of surfaces", 5);
      text_.skip_line();
      for (std::size_t i = 0; i < count; ++i) read_surface(object.mesh);
    } else if (keyword == "kids") {
      object.kids = text_.count("the number of kids", 8);
      text_.skip_line();
      end_object_without_kids();
    } else {
      if (std::find(std::begin(kLooks), std::end(kLooks), keyword) == std::end(kLooks))
        ++unknown_[std::string(keyword)];
      text_.skip_line();
    }
  }

  /// Bytes of any kind, with their number.
  void skip_data() {
    const std::size_t bytes = text_.count("the number of bytes", 1);
    text_.skip_line();
    if (bytes > text_.remaining().size()) text_.fail_truncated("the end of the data");
    text_.seek(text_.position() + bytes);
    text_.skip_line();
  }

  /// A vertex may have a normal, as in TORCS.
  void read_vertices(MeshData& mesh) {
    const std::size_t count = text_.count("the number of vertices", 6);
    text_.skip_line();
    mesh.vertices.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      beat(source_.watch);
      mesh.vertices.push_back(text_.point());
      text_.skip_line();
    }
  }

  void read_surface(MeshData& mesh) {
    beat(source_.watch);
    if (text_.word("SURF") != "SURF") text_.fail("expected SURF");
    const std::uint64_t kind = flags(text_.word("the flags of a surface")) & 15;
    const std::size_t place = text_.last();
    int material = 0;
    std::string_view keyword = text_.word("refs");
    for (; keyword != "refs"; keyword = text_.word("refs")) {
      if (keyword != "mat") text_.fail("expected mat or refs, found " + in_quotes(keyword));
      material = material_number();
    }
    const std::size_t count = text_.count("the number of corners", 2);
    text_.skip_line();
    corners_.clear();
    for (std::size_t i = 0; i < count; ++i) {
      corners_.push_back(text_.index("a vertex", 0, mesh.vertices.size()));
      text_.skip_line();
    }
    const auto refuse = [&](const std::string& reason) { text_.fail_at(place, reason); };
    if (kind == kPolygon)
      add_face(mesh, corners_, material, refuse);
    else if (kind == kStrip)
      add_strip(mesh, corners_, material);
    else if (kind == kClosedLine || kind == kOpenLine)
      ++lines_;
    else
      refuse("unknown kind of surface " + std::to_string(kind));
  }

  std::uint64_t flags(std::string_view word) const {
    std::uint64_t value = 0;
    std::string_view digits = word;
    const bool hexadecimal = digits.starts_with("0x") || digits.starts_with("0X");
    if (hexadecimal) digits.remove_prefix(2);
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value, hexadecimal ? 16 : 10);
    if (error != std::errc() || end != digits.data() + digits.size())
      text_.fail("expected the flags of a surface, found " + in_quotes(word));
    return value;
  }

  /// From 1; 0: none. Files number materials that they do not have.
  int material_number() {
    const std::int64_t material = text_.integer("a material");
    return material >= 0 && static_cast<std::size_t>(material) < materials_.size()
               ? static_cast<int>(material) + 1
               : 0;
  }

  /// The placement of the innermost open object.
  [[nodiscard]] Placement placement() const {
    Placement result;
    for (const Object& object : open_) result = result.after(object.own);
    return result;
  }

  /// Puts the object whose 'kids' were read, and ends it and all objects of which it is the last kid.
  void end_object_without_kids() {
    put(open_.back());
    while (!open_.empty() && open_.back().kids == 0) {
      open_.pop_back();
      if (!open_.empty()) --open_.back().kids;
    }
  }

  /// Adds the faces of an object, with the vertices that these have.
  void put(Object& object) {
    MeshData& mesh = object.mesh;
    counts_.add(mesh.polygon_counts);
    Solid solid{object.name, {}, std::move(mesh.facets), materials_, {}};
    std::vector<Index> place(mesh.vertices.size(), no_entity);
    for (const Triangle& facet : solid.facets)
      for (const Index corner : facet) place[corner] = 0;
    for (std::size_t v = 0; v < place.size(); ++v) {
      if (place[v] == no_entity) continue;
      place[v] = static_cast<Index>(solid.vertices.size());
      solid.vertices.push_back(mesh.vertices[v]);
    }
    unused_ += mesh.vertices.size() - solid.vertices.size();
    if (solid.facets.empty()) return;
    solid.facet_material.reserve(solid.facets.size());
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
      for (Index& corner : solid.facets[f]) corner = place[corner];
      solid.facet_material.push_back(static_cast<std::size_t>(mesh.facet_markers.of(f)));
    }
    solids_.add(solid, object.name, placement());
  }

  Source source_;
  TextReader text_;
  Solids solids_;
  std::vector<std::string> materials_;
  std::vector<Object> open_;  ///< from the outermost to the innermost
  std::vector<Index> corners_;
  PolygonCounts counts_;
  std::size_t lines_ = 0, unused_ = 0;
  std::map<std::string, std::size_t> unknown_;
};

}  // namespace

MeshData read_ac3d(const Source& source) { return Ac3dReader(source).read(); }

}  // namespace holdfast::io
