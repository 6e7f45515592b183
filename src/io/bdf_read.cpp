// Reads Nastran's bulk data, .bdf, .nas and .fem: GRID, CTETRA, CTRIA3, CTRIA6, CTRIAR, CQUAD4 and rods, in
// the fields of bdf_card.h. Properties are regions and markers; names come from the comments of HyperMesh and
// ANSA.
#include <algorithm>
#include <map>
#include <optional>

#include "io/bdf_card.h"
#include "io/cells.h"
#include "io/exact_nodes.h"
#include "io/fields.h"
#include "io/formats.h"
#include "io/labels.h"
#include "io/mid_nodes.h"
#include "io/numbered.h"
#include "io/polygon.h"

namespace holdfast::io {
namespace {

class BdfReader {
 public:
  explicit BdfReader(const Source& source) : text_(source, '\0') {}

  MeshData read() {
    skip_to_bulk();
    while (read_card()) {
      text_.seek(place_);
      use_card();
      text_.seek(behind_);
    }
    if (const auto twice = nodes_.finish())
      throw FileError(text_.source().path, "", "the grid point " + std::to_string(*twice) + " occurs twice");
    if (has_default_system_ && default_system_)
      text_.fail_at(*default_system_, "grid points in a coordinate system of their own are not read");
    for (const Element& element : elements_) add(element);
    if (mesh_.vertices.empty()) throw FileError(text_.source().path, "", "the file has no GRID");
    tell_skipped();
    mesh_.names = {markers_.take(), regions_.take(), {}, {}};
    return std::move(mesh_);
  }

 private:
  struct Element {
    std::string name;
    int property;
    std::vector<std::int64_t> nodes;  ///< corners, then those nodes on edges that exist
    std::size_t position;
    std::size_t corners;
  };

  /// The bulk data begins after BEGIN BULK or, without it, at the start of the file.
  void skip_to_bulk() {
    const std::size_t start = text_.position();
    while (!text_.remaining().empty()) {
      const std::string_view line = trimmed(text_.rest_of_line());
      if (line.starts_with('$')) read_comment(line);
      const std::string lowered = lower(line.substr(0, 16));
      if (lowered.starts_with("begin") && lowered.find("bulk") != std::string::npos) return;
    }
    text_.seek(start);
  }

  /// Reads $HMNAME PROP <id>"<name>" or $ANSA_NAME_COMMENT;<id>;<card>;<name>, or our comments for ids and
  /// exact coordinates.
  void read_comment(std::string_view line) {
    if (read_id_comment(line.substr(1), std::array{&regions_, &markers_})) return;
    exact_nodes_.read(line.substr(1));
    const std::string lowered = lower(line.substr(0, 20));
    std::string_view number, name;
    if (lowered.starts_with("$hmname prop")) {
      const std::size_t start = line.find('"'), end = line.rfind('"');
      if (start == end) return;
      number = trimmed(line.substr(12, start - 12));
      name = line.substr(start + 1, end - start - 1);
    } else if (lowered.starts_with("$ansa_name_comment;")) {
      const std::vector<std::string_view> fields = split(line, ';');
      if (fields.size() < 4) return;
      number = fields[1];
      name = fields[3];
    }
    int id = 0;
    const auto result = std::from_chars(number.data(), number.data() + number.size(), id);
    if (number.empty() || result.ec != std::errc() || result.ptr != number.data() + number.size()) return;
    comments_[id] = std::string(name);
  }

  /// The next line that is no comment, without a trailing comment.
  bool next_line(std::string_view& line) {
    while (!text_.remaining().empty()) {
      beat(text_.source().watch);
      line = text_.rest_of_line();
      if (line.starts_with('$')) read_comment(line);
      line = line.substr(0, line.find('$'));
      if (!trimmed(line).empty()) return true;
    }
    return false;
  }

  bool read_card() {
    std::string_view line;
    if (!next_line(line)) return false;
    card_ = {};
    place_ = text_.last();
    card_.add(line);
    for (;;) {
      behind_ = text_.position();
      if (!next_line(line) || !BdfCard::continues(line)) break;
      card_.add(line);
    }
    text_.seek(behind_);
    return true;
  }

  [[nodiscard]] std::string_view field(std::size_t i) const { return card_.field(i); }

  void use_card() {
    const std::string& name = card_.name();
    static_cast<void>(text_.rest_of_line());  // errors then name the card's line
    if (name == "grid") {
      read_grid();
    } else if (name == "grdset") {
      read_grid_defaults();
    } else if (name == "ctetra") {
      read_element(2, 4, 10);
    } else if (name == "ctria3" || name == "ctriar") {
      read_element(2, 3, 3);
    } else if (name == "ctria6") {
      read_element(2, 3, 6);
    } else if (name == "cquad4" || name == "cquadr") {
      read_element(2, 4, 4);
    } else if (name == "cquad8") {
      read_element(2, 4, 8);
    } else if (name == "crod" || name == "cbar" || name == "cbeam" || name == "ctube") {
      read_element(2, 2, 2);
    } else if (name == "chexa") {
      read_element(2, 8, 20);
    } else if (name == "cpenta") {
      read_element(2, 6, 15);
    } else if (name == "cpyram") {
      read_element(2, 5, 13);
    } else if (name.starts_with("include")) {
      text_.fail("INCLUDE is not followed; read the file that it names");
    } else if (name == "enddata") {
      behind_ = text_.source().bytes.size();
    } else {
      ++skipped_[name.substr(0, 16)];
    }
  }

  void read_grid() {
    const std::int64_t number = integer_of(text_, field(0), "a grid point's number");
    nodes_.add(number);
    if (field(1).empty())
      has_default_system_ = true;
    else if (integer_of(text_, field(1), "a coordinate system") != 0)
      text_.fail("a grid point in a coordinate system of its own is not read");
    Point point{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!field(2 + axis).empty()) point[axis] = real_of(text_, field(2 + axis), "a coordinate");
    mesh_.vertices.push_back(exact_nodes_.of(number, point));
  }

  /// GRDSET, before or after the grid points, sets the coordinate system of those that name none.
  void read_grid_defaults() {
    if (!field(1).empty() && integer_of(text_, field(1), "a coordinate system") != 0)
      default_system_ = place_;
    ++skipped_["grdset"];
  }

  void read_element(std::size_t first, std::size_t corners, std::size_t most) {
    Element element{
        card_.name(), field(1).empty() ? 0 : id_of(text_, field(1), "a property"), {}, place_, corners};
    if (field(1).empty()) element.property = id_of(text_, field(0), "an element's number");
    for (std::size_t i = first; i < first + most; ++i) {
      if (field(i).empty() && i >= first + corners) continue;
      element.nodes.push_back(integer_of(text_, field(i), "a grid point's number"));
    }
    elements_.push_back(std::move(element));
  }

  /// The id of a property, which its name may contain.
  int id_of_property(NamedIds& names, std::map<int, int>& known, int property) {
    const auto [there, fresh] = known.try_emplace(property, 0);
    if (!fresh) return there->second;
    if (const auto found = comments_.find(property); found != comments_.end())
      names.set(property, found->second);
    return there->second = names.resolve(property);
  }

  void add(const Element& element) {
    std::array<Index, 20> n{};
    for (std::size_t i = 0; i < element.nodes.size(); ++i) {
      const std::optional<Index> found = nodes_.find(element.nodes[i]);
      if (!found)
        text_.fail_at(element.position,
                      "the grid point " + std::to_string(element.nodes[i]) + " does not exist");
      n[i] = *found;
    }
    if (element.name == "ctetra") {
      const int id = id_of_property(regions_, ids_of_regions_, element.property);
      if (element.nodes.size() == 10)
        return add_second_order(mesh_, Tetrahedron{n[0], n[1], n[2], n[3]},
                                {n[4], n[5], n[6], n[7], n[8], n[9]}, id);
      mesh_.add_tetrahedron({n[0], n[1], n[2], n[3]}, id);
      return add_no_corners(mesh_, std::span(n).first(element.nodes.size()).subspan(4));
    }
    if (element.corners > 4)
      return add_cell(mesh_, std::span(n).first(element.nodes.size()), element.corners,
                      id_of_property(regions_, ids_of_regions_, element.property));
    if (element.nodes.size() == 2) return mesh_.add_segment({n[0], n[1]}, element.property);
    const int id = id_of_property(markers_, ids_of_markers_, element.property);
    if (element.nodes.size() == 6 && element.corners == 3)
      return add_second_order(mesh_, Triangle{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, id);
    add_polygon(mesh_, std::span(n).first(element.corners), id,
                [&](const std::string& reason) { text_.fail_at(element.position, reason); });
    add_no_corners(mesh_, std::span(n).first(element.nodes.size()).subspan(element.corners));
  }

  void tell_skipped() {
    mesh_.leave_out(
        skipped_, [](const std::string& name) { return in_quotes(name); }, "cards", "card");
  }

  TextReader text_;
  BdfCard card_;
  std::size_t place_ = 0, behind_ = 0;  ///< where the card begins and ends
  MeshData mesh_;
  Numbered nodes_;
  ExactNodes exact_nodes_{nastran_rounded};
  std::vector<Element> elements_;
  std::map<int, std::string> comments_;
  std::map<int, int> ids_of_regions_, ids_of_markers_;
  NamedIds regions_{kRegionStem}, markers_{kFacetStem};
  std::map<std::string, std::size_t> skipped_;
  bool has_default_system_ = false;  ///< whether some grid point names no coordinate system
  std::optional<std::size_t>
      default_system_;  ///< position of a GRDSET with another system than the basic one
};

}  // namespace

MeshData read_bdf(const Source& source) { return BdfReader(source).read(); }

}  // namespace holdfast::io
