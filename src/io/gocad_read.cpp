// GOCAD's text objects (Paradigm, GOCAD ASCII file formats): TSurf, the triangulated surfaces of geology,
// with PLine and VSet for segments and points. Each object numbers its own vertices, and becomes a marker if
// there are several.
#include <map>

#include "io/formats.h"
#include "io/labels.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

class GocadReader {
 public:
  explicit GocadReader(const Source& source) : text_(source), mesh_(source) {}

  MeshData read() {
    while (!text_.at_end()) {
      const std::string_view keyword = text_.word_on_line();
      if (keyword == "GOCAD")
        begin_object();
      else if (objects_ == 0)
        text_.fail("expected 'GOCAD', found " + in_quotes(keyword));
      else
        read_line(keyword);
      text_.skip_line();
    }
    if (is_open_)
      mesh_.remarks.push_back(
          {RemarkKind::left_out, 1, "the file ends without 'END': triangles may be missing"});
    name_facets();
    mesh_.leave_out(properties_, "sets of properties of vertices", "set of properties of a vertex");
    return std::move(mesh_);
  }

 private:
  void begin_object() {
    if (is_open_) text_.fail("the object before does not end with 'END'");
    const std::string_view kind = text_.word_on_line();
    if (kind != "TSurf" && kind != "PLine" && kind != "VSet")
      text_.fail("objects of the kind " + in_quotes(kind) + " are not read; TSurf, PLine and VSet are");
    is_open_ = true;
    ++objects_;
    number_of_.clear();
    name_.clear();
    facets_before_ = mesh_.facets.size();
  }

  void read_line(std::string_view keyword) {
    if (keyword == "VRTX" || keyword == "PVRTX") {
      read_vertex(keyword == "PVRTX");
    } else if (keyword == "ATOM" || keyword == "PATOM") {
      const std::int64_t number = text_.integer("a vertex's number");
      add_number(number, vertex());
    } else if (keyword == "TRGL") {
      const Index a = vertex(), b = vertex(), c = vertex();
      mesh_.add_facet({a, b, c}, static_cast<int>(objects_));
    } else if (keyword == "SEG") {
      const Index a = vertex(), b = vertex();
      mesh_.add_segment({a, b}, static_cast<int>(objects_));
    } else if (keyword == "TETRA") {
      text_.fail("tetrahedra of GOCAD are not read");
    } else if (keyword == "ZPOSITIVE") {
      read_direction();
    } else if (keyword == "END") {
      end_object();
    } else if (name_.empty() && (keyword.starts_with("name:") || keyword.starts_with("*name:"))) {
      name_ = cleaned_name(std::string(keyword.substr(keyword.find(':') + 1)) +
                           std::string(text_.remaining().substr(0, text_.remaining().find_first_of("\r\n"))));
    }
  }

  void end_object() {
    is_open_ = false;
    if (mesh_.facets.size() > facets_before_) names_[static_cast<int>(objects_)] = name_;
  }

  void read_vertex(bool has_properties) {
    const std::int64_t number = text_.integer("a vertex's number");
    add_number(number, static_cast<Index>(mesh_.vertices.size()));
    mesh_.vertices.push_back(text_.point());
    properties_ += has_properties && !text_.at_line_end() ? 1 : 0;
  }

  void add_number(std::int64_t number, Index vertex) {
    if (!number_of_.try_emplace(number, vertex).second)
      text_.fail("the object has two vertices of the number " + std::to_string(number));
  }

  Index vertex() {
    const std::int64_t number = text_.integer("a vertex's number");
    const auto found = number_of_.find(number);
    if (found == number_of_.end())
      text_.fail("the object has no vertex " + std::to_string(number) + " before this line");
    return found->second;
  }

  /// Mixing depths and elevations would mirror part of the mesh.
  void read_direction() {
    const std::string direction = lower(text_.word_on_line());
    if (direction_.empty()) direction_ = direction;
    if (direction != direction_)
      text_.fail("z is the " + in_quotes(direction) + " here and the " + in_quotes(direction_) +
                 " in an object before: export them alike");
  }

  /// A single surface gets a name but no marker.
  void name_facets() {
    if (is_open_) end_object();
    const bool several = names_.size() > 1;
    for (const auto& [id, name] : names_)
      if (!name.empty()) mesh_.names.facets[several ? id : 0] = name;
    if (!several) mesh_.facet_markers = {};
    if (objects_ < 2) mesh_.segment_markers = {};
  }

  TextReader text_;
  MeshData mesh_;
  std::map<std::int64_t, Index> number_of_;  ///< by number in the object
  std::map<int, std::string> names_;         ///< of objects with triangles
  std::size_t objects_ = 0, facets_before_ = 0, properties_ = 0;
  std::string name_, direction_;
  bool is_open_ = false;
};

}  // namespace

MeshData read_gocad(const Source& source) { return GocadReader(source).read(); }

}  // namespace holdfast::io
