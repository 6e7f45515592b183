// Reads I-DEAS universal files: nodes (2411, 781, 15), elements (2412) and permanent groups (2467, 2477 and
// older forms). A group is a region or a marker; if a kind of element has no groups, the number of its
// physical property is used.
#include <algorithm>
#include <map>
#include <set>

#include "io/cells.h"
#include "io/fields.h"
#include "io/formats.h"
#include "io/labels.h"
#include "io/mid_nodes.h"
#include "io/numbered.h"
#include "io/polygon.h"
#include "numbers/sorted.h"

namespace holdfast::io {
namespace {

class UnvReader {
 public:
  explicit UnvReader(const Source& source) : text_(source, '\0') {}

  MeshData read() {
    while (next()) {
      if (line_ != "-1") text_.fail("expected -1, which begins a dataset, found " + in_quotes(line_));
      if (!next()) text_.fail_truncated("a dataset's number");
      read_dataset(integer_of(text_, line_, "a dataset's number"));
    }
    if (nodes_.size() == 0)
      throw FileError(text_.source().path, "", "the file holds no nodes (dataset 2411, 781 or 15)");
    if (const auto twice = numbers_.finish()) fail_twice("element", *twice);
    give_ids();
    mesh_.leave_out(skipped_, "datasets of other kinds", "dataset of another kind");
    return std::move(mesh_);
  }

 private:
  struct Element {
    int dimension;
    Index entity, count;
    int property;
  };
  struct Group {
    std::vector<std::int64_t> members;
  };

  bool next() {
    while (!text_.remaining().empty()) {
      beat(text_.source().watch);
      line_ = trimmed(text_.rest_of_line());
      if (!line_.empty()) return true;
    }
    line_ = {};
    return false;
  }
  /// Reads the next line of a dataset; returns false at its end.
  bool next_in_dataset() {
    if (!next()) text_.fail_truncated("-1, which ends a dataset,");
    return line_ != "-1";
  }

  std::vector<std::string_view> words() const { return words_of(line_); }

  void read_dataset(std::int64_t number) {
    switch (number) {
      case 2411:
      case 781:
        return read_nodes();
      case 15:
        return read_nodes_of_one_line();
      case 2412:
        return read_elements();
      case 2467:
      case 2477:
      case 2452:
      case 2435:
        return read_groups();
      default:
        // Units, headers and coordinate systems do not affect the mesh.
        if (number != 151 && number != 164 && number != 2420) ++skipped_;
        while (next_in_dataset()) {
        }
    }
  }

  void read_nodes() {
    while (next_in_dataset()) {
      nodes_.add(integer_of(text_, words()[0], "a node's number"));
      if (!next_in_dataset()) text_.fail("a node without coordinates");
      const std::vector<std::string_view> fields = words();
      if (fields.size() < 3) text_.fail("a node needs three coordinates");
      add_vertex(fields[0], fields[1], fields[2]);
    }
    if (const auto twice = nodes_.finish()) fail_twice("node", *twice);
  }

  // Reads a number, two coordinate systems and a colour, then the coordinates.
  void read_nodes_of_one_line() {
    while (next_in_dataset()) {
      const std::vector<std::string_view> fields = words();
      if (fields.size() < 7) text_.fail("a node of dataset 15 has seven numbers");
      nodes_.add(integer_of(text_, fields[0], "a node's number"));
      add_vertex(fields[4], fields[5], fields[6]);
    }
    if (const auto twice = nodes_.finish()) fail_twice("node", *twice);
  }

  void add_vertex(std::string_view x, std::string_view y, std::string_view z) {
    mesh_.vertices.push_back({real_of(text_, x, "a coordinate"), real_of(text_, y, "a coordinate"),
                              real_of(text_, z, "a coordinate")});
  }

  void read_elements() {
    while (next_in_dataset()) {
      const std::vector<std::string_view> head = words();
      if (head.size() < 6) text_.fail("an element's first line has six numbers");
      const std::int64_t number = integer_of(text_, head[0], "an element's number"),
                         type = integer_of(text_, head[1], "an element's type");
      const int property = id_of(text_, head[2], "a physical property");
      const std::int64_t count = integer_of(text_, head[5], "the number of nodes");
      if (count < 1 || count > 27)
        text_.fail("the number of nodes is out of range: " + std::to_string(count));
      const bool beam = type == 11 || (type >= 21 && type <= 24);
      if (beam && !next_in_dataset()) text_.fail("a beam without its second line");
      std::vector<Index> nodes;
      while (nodes.size() < static_cast<std::size_t>(count)) {
        if (!next_in_dataset()) text_.fail("an element without its nodes");
        for (const std::string_view field : words()) nodes.push_back(vertex(field));
      }
      if (nodes.size() != static_cast<std::size_t>(count)) text_.fail("more nodes than the element has");
      add(type, nodes, number, property);
    }
  }

  Index vertex(std::string_view field) const {
    const std::int64_t number = integer_of(text_, field, "a node's number");
    const std::optional<Index> found = nodes_.find(number);
    if (!found) text_.fail("the node " + std::to_string(number) + " does not exist");
    return *found;
  }

  static std::vector<Index> in_order(const std::vector<Index>& n, std::initializer_list<std::size_t> places) {
    std::vector<Index> ordered;
    for (const std::size_t k : places) ordered.push_back(n[k]);
    return ordered;
  }

  void add(std::int64_t type, const std::vector<Index>& n, std::int64_t number, int property) {
    const auto has = [&](std::size_t count) {
      if (n.size() != count)
        text_.fail("an element of type " + std::to_string(type) + " has " + std::to_string(n.size()) +
                   " nodes");
    };
    const std::size_t before[] = {0, mesh_.segments.size(), mesh_.facets.size(), mesh_.tetrahedra.size()};
    std::size_t dimension = 2;
    switch (type) {
      case 111:
        has(4);
        dimension = 3;
        mesh_.add_tetrahedron({n[0], n[1], n[2], n[3]});
        break;
      case 118:
        has(10);
        dimension = 3;
        add_second_order(mesh_, Tetrahedron{n[0], n[2], n[4], n[9]}, {n[1], n[3], n[5], n[6], n[7], n[8]}, 0);
        break;
      case 112:
      case 115:
        has(type == 112 ? 6 : 8);
        dimension = 3;
        add_cell(mesh_, n, n.size(), 0);
        break;
      case 113:  // a triangle with mid-edge nodes, the nodes between, the other triangle
        has(15);
        dimension = 3;
        add_cell(mesh_, in_order(n, {0, 2, 4, 9, 11, 13, 1, 3, 5, 6, 7, 8, 10, 12, 14}), 6, 0);
        break;
      case 116:
        has(20);
        dimension = 3;
        add_cell(mesh_, in_order(n, {0, 2, 4, 6, 12, 14, 16, 18, 1, 3, 5, 7, 8, 9, 10, 11, 13, 15, 17, 19}),
                 8, 0);
        break;
      case 41:
      case 51:
      case 61:
      case 74:
      case 91:
        has(3);
        mesh_.add_facet({n[0], n[1], n[2]});
        break;
      case 42:
      case 52:
      case 62:
      case 72:
      case 92:
        has(6);
        add_second_order(mesh_, Triangle{n[0], n[2], n[4]}, {n[1], n[3], n[5]}, 0);
        break;
      case 44:
      case 54:
      case 64:
      case 71:
      case 94:
        has(4);
        add_polygon(mesh_, n, 0, [&](const std::string& reason) { text_.fail(reason); });
        break;
      case 45:
      case 55:
      case 65:
      case 75:
      case 95: {
        has(8);
        const std::vector<Index> corners = in_order(n, {0, 2, 4, 6});
        add_no_corners(mesh_, in_order(n, {1, 3, 5, 7}));
        add_polygon(mesh_, corners, 0, [&](const std::string& reason) { text_.fail(reason); });
        break;
      }
      case 11:
      case 21:
      case 22:
        has(2);
        dimension = 1;
        mesh_.add_segment({n[0], n[1]});
        break;
      case 24:
        has(3);
        dimension = 1;
        add_second_order(mesh_, Segment{n[0], n[2]}, n[1], 0);
        break;
      default:
        text_.fail("elements of type " + std::to_string(type) +
                   " are not read; only tetrahedra, hexahedra, prisms, triangles, quadrangles and beams are");
    }
    const std::size_t after[] = {0, mesh_.segments.size(), mesh_.facets.size(), mesh_.tetrahedra.size()};
    numbers_.add(number);
    elements_.push_back({static_cast<int>(dimension), static_cast<Index>(before[dimension]),
                         static_cast<Index>(after[dimension] - before[dimension]), property});
  }

  // Groups with one name in a dataset are merged, for instance if tetrahedra and triangles share it. Another
  // dataset may repeat a group with some of its elements.
  void read_groups() {
    std::map<std::string, Group> here;
    while (next_in_dataset()) {
      const std::vector<std::string_view> head = words();
      if (head.size() < 2) text_.fail("a group's first line has eight numbers");
      const std::int64_t count = integer_of(text_, head.back(), "the number of a group's entities");
      if (count < 0) text_.fail("a group of a negative number of entities");
      line_ = trimmed(text_.rest_of_line());
      Group& group = here[std::string(line_)];
      for (std::int64_t read = 0; read < count;) {
        if (!next_in_dataset()) text_.fail("a group of fewer entities than it announces");
        const std::vector<std::string_view> fields = words();
        if (fields.size() < 4 || fields.size() % 4 != 0)
          text_.fail("a group's entities have four numbers each");
        for (std::size_t i = 0; i + 3 < fields.size() && read < count; i += 4, ++read)
          if (integer_of(text_, fields[i], "an entity's type") == 8)
            group.members.push_back(integer_of(text_, fields[i + 1], "an entity's number"));
      }
    }
    for (auto& [name, group] : here) {
      sort_unique(group.members);
      Group& known = groups_[name];
      if (known.members.size() < group.members.size()) known = std::move(group);
    }
  }

  [[noreturn]] void fail_twice(const char* what, std::int64_t number) const {
    throw FileError(text_.source().path, "",
                    "the " + std::string(what) + " " + std::to_string(number) + " occurs twice");
  }

  struct Part {  ///< the elements of a group with one dimension
    const std::string* name;
    std::vector<Index> elements;
    std::optional<int> property;  ///< set if all of these elements, and no others, have it
  };

  std::vector<Part> parts_of(int dimension) const {
    std::map<int, std::size_t> of_property;
    for (const Element& element : elements_)
      if (element.dimension == dimension) ++of_property[element.property];
    std::vector<Part> parts;
    for (const auto& [name, group] : groups_) {
      Part part{&name, {}, {}};
      for (const std::int64_t number : group.members) {
        const std::optional<Index> found = numbers_.find(number);
        if (!found)
          throw FileError(text_.source().path, "",
                          "the element " + std::to_string(number) + " of the group " + in_quotes(name) +
                              " does not exist");
        if (elements_[*found].dimension == dimension) part.elements.push_back(*found);
      }
      if (part.elements.empty()) continue;
      const int first = elements_[part.elements[0]].property;
      const bool alike = std::all_of(part.elements.begin(), part.elements.end(),
                                     [&](Index e) { return elements_[e].property == first; });
      if (alike && first > 0 && of_property[first] == part.elements.size()) part.property = first;
      parts.push_back(std::move(part));
    }
    // Where groups overlap, the smaller one counts; groups with a property come first.
    std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
      if (a.property.has_value() != b.property.has_value()) return a.property.has_value();
      return a.elements.size() > b.elements.size();
    });
    return parts;
  }

  std::vector<int> ids_of(int dimension, std::size_t entities, NamedIds& names) const {
    std::vector<int> ids(entities, 0);
    const std::vector<Part> parts = parts_of(dimension);
    const auto give = [&](const Element& element, int id) {
      for (Index k = 0; k < element.count; ++k) ids[element.entity + k] = id;
    };
    if (parts.empty())
      for (const Element& element : elements_)
        if (element.dimension == dimension) give(element, element.property);
    for (const Part& part : parts) {
      if (part.property) names.set(*part.property, *part.name);
      const int id = part.property ? names.resolve(*part.property) : names.id_of(*part.name);
      for (const Index e : part.elements) give(elements_[e], id);
    }
    return ids;
  }

  void give_ids() {
    NamedIds regions(kRegionStem), facets(kFacetStem), segments(kSegmentStem);
    const std::vector<int> of_tets = ids_of(3, mesh_.tetrahedra.size(), regions),
                           of_facets = ids_of(2, mesh_.facets.size(), facets),
                           of_segments = ids_of(1, mesh_.segments.size(), segments);
    for (std::size_t i = 0; i < of_tets.size(); ++i) mesh_.regions.add(i, of_tets[i]);
    for (std::size_t i = 0; i < of_facets.size(); ++i) mesh_.facet_markers.add(i, of_facets[i]);
    for (std::size_t i = 0; i < of_segments.size(); ++i) mesh_.segment_markers.add(i, of_segments[i]);
    mesh_.names = {facets.take(), regions.take(), segments.take(), {}};
  }

  TextReader text_;
  std::string_view line_;
  MeshData mesh_;
  Numbered nodes_, numbers_;
  std::vector<Element> elements_;
  std::map<std::string, Group> groups_;
  std::size_t skipped_ = 0;
};

}  // namespace

MeshData read_unv(const Source& source) { return UnvReader(source).read(); }

}  // namespace holdfast::io
