// Reads Abaqus's and CalculiX's .inp: nodes, tetrahedra, triangles and lines, element sets and surfaces of
// elements and sides (CalculiX CrunchiX user's manual, "Input deck format").
//
// Sets of tetrahedra are regions, those of triangles and surfaces markers. Where sets overlap, the smaller
// one counts.
#include <algorithm>
#include <map>

#include "io/fields.h"
#include "io/formats.h"
#include "io/labels.h"
#include "io/mesh_sets.h"
#include "io/mid_nodes.h"
#include "io/numbered.h"
#include "io/polygon.h"
#include "numbers/sorted.h"

namespace holdfast::io {
namespace {

struct ElementType {
  std::string_view prefix;
  int dimension;
  std::size_t nodes, corners;
};

/// The longest prefix of a type's name counts.
constexpr ElementType kTypes[] = {
    {"c3d4", 3, 4, 4},    {"c3d10", 3, 10, 4}, {"dc3d4", 3, 4, 4},  {"dc3d10", 3, 10, 4}, {"ac3d4", 3, 4, 4},
    {"ac3d10", 3, 10, 4}, {"s3", 2, 3, 3},     {"ds3", 2, 3, 3},    {"stri3", 2, 3, 3},   {"cps3", 2, 3, 3},
    {"cpe3", 2, 3, 3},    {"m3d3", 2, 3, 3},   {"sfm3d3", 2, 3, 3}, {"r3d3", 2, 3, 3},    {"s6", 2, 6, 3},
    {"ds6", 2, 6, 3},     {"stri65", 2, 6, 3}, {"cps6", 2, 6, 3},   {"cpe6", 2, 6, 3},    {"m3d6", 2, 6, 3},
    {"sfm3d6", 2, 6, 3},  {"s4", 2, 4, 4},     {"cps4", 2, 4, 4},   {"cpe4", 2, 4, 4},    {"m3d4", 2, 4, 4},
    {"sfm3d4", 2, 4, 4},  {"r3d4", 2, 4, 4},   {"t3d2", 1, 2, 2},   {"b31", 1, 2, 2},     {"b21", 1, 2, 2},
    {"t2d2", 1, 2, 2},    {"t3d3", 1, 3, 2},   {"b32", 1, 3, 2}};

struct Element {
  int dimension;
  Index entity;  ///< of the mesh: its index among those of the dimension, the first of a polygon
  Index count;   ///< of a polygon that is cut: how many facets
};

struct Keyword {
  std::string name;                           ///< in lower case
  std::map<std::string, std::string> values;  ///< by parameter in lower case
};

/// Sides S1 to S4 of a tetrahedron, by the corner opposite them.
constexpr std::array<std::size_t, 4> kOpposite{3, 2, 0, 1};

class InpReader {
 public:
  explicit InpReader(const Source& source) : text_(source, '\0') {}

  MeshData read() {
    if (!next()) text_.fail_truncated("a keyword");
    while (!line_.empty()) read_block();
    finish_numbers();
    make_surfaces();
    apply_sets();
    tell_skipped();
    return std::move(mesh_);
  }

 private:
  /// The next line that is no comment; whether there is one.
  bool next() {
    while (!text_.remaining().empty()) {
      line_ = trimmed(text_.rest_of_line());
      beat(text_.source().watch);
      if (!line_.empty() && !line_.starts_with("**")) return true;
      if (!line_.empty()) read_id_comment(line_.substr(2), std::array{&regions_by_name_, &markers_by_name_});
    }
    line_ = {};
    return false;
  }

  Keyword keyword() {
    if (line_[0] != '*') text_.fail("expected a keyword, found " + in_quotes(line_));
    std::string all(line_.substr(1));
    while (all.ends_with(',') && next()) all += line_;
    const std::vector<std::string_view> fields = split(all, ',');
    Keyword result{lower(fields[0]), {}};
    for (const std::string_view field : std::span(fields).subspan(1)) {
      const std::size_t equals = field.find('=');
      std::string_view value = equals == std::string_view::npos ? "" : trimmed(field.substr(equals + 1));
      if (value.size() >= 2 && value.front() == '"' && value.back() == '"')
        value = value.substr(1, value.size() - 2);
      result.values[lower(trimmed(field.substr(0, equals)))] = std::string(value);
    }
    return result;
  }

  void read_block() {
    const Keyword key = keyword();
    const auto has = [&](const char* parameter) { return key.values.contains(parameter); };
    next();
    if (key.name == "node") {
      read_nodes();
    } else if (key.name == "element") {
      read_elements(key);
    } else if (key.name == "elset" && has("elset")) {
      read_set(key);
    } else if (key.name == "surface" && has("name") &&
               (!has("type") || lower(key.values.at("type")) == "element")) {
      read_surface(key.values.at("name"));
    } else if (key.name == "include") {
      text_.fail("*INCLUDE is not followed; read the file that it names");
    } else {
      if (is_data()) ++skipped_[key.name];
      while (is_data()) next();
    }
  }

  [[nodiscard]] bool is_data() const { return !line_.empty() && line_[0] != '*'; }

  void read_nodes() {
    for (; is_data(); next()) {
      const std::vector<std::string_view> fields = split(line_, ',');
      if (fields.size() < 3) text_.fail("a node needs a number and its coordinates");
      nodes_.add(integer_of(text_, fields[0], "a node's number"));
      Point point{};
      for (std::size_t axis = 0; axis < 3 && axis + 1 < fields.size(); ++axis)
        if (!fields[axis + 1].empty()) point[axis] = real_of(text_, fields[axis + 1], "a coordinate");
      mesh_.vertices.push_back(point);
    }
  }

  const ElementType& type_of(const Keyword& key) {
    const auto found = key.values.find("type");
    if (found == key.values.end()) text_.fail("*ELEMENT without TYPE");
    const std::string name = lower(found->second);
    const ElementType* best = nullptr;
    for (const ElementType& type : kTypes)
      if (name.starts_with(type.prefix) && (best == nullptr || type.prefix.size() > best->prefix.size()))
        best = &type;
    const char behind =
        best == nullptr || name.size() == best->prefix.size() ? ' ' : name[best->prefix.size()];
    if (best == nullptr || (behind >= '0' && behind <= '9'))
      text_.fail("elements of type " + in_quotes(found->second) +
                 " are not read; only tetrahedra, triangles, quadrangles and lines are");
    return *best;
  }

  /// The numbers of the lines that follow, by elements of a number and so many nodes, which may take several.
  void read_elements(const Keyword& key) {
    const ElementType& type = type_of(key);
    if (const auto twice = nodes_.finish()) fail_twice("node", *twice);
    const auto set = key.values.find("elset");
    std::vector<std::int64_t>* members = set == key.values.end() ? nullptr : &own_sets_[set->second];
    if (members != nullptr && std::find(order_.begin(), order_.end(), set->second) == order_.end())
      order_.push_back(set->second);
    while (is_data()) {
      std::vector<std::int64_t> numbers;
      for (; is_data() && numbers.size() < type.nodes + 1; next())
        for (const std::string_view field : split(line_, ','))
          if (!field.empty()) numbers.push_back(integer_of(text_, field, "a number of an element or node"));
      if (numbers.size() != type.nodes + 1)
        text_.fail("an element of " + std::to_string(type.nodes) + " nodes has " +
                   std::to_string(numbers.empty() ? 0 : numbers.size() - 1));
      std::array<Index, 10> nodes{};
      for (std::size_t i = 0; i < type.nodes; ++i) nodes[i] = vertex(numbers[i + 1]);
      add(type, nodes, numbers[0]);
      if (members != nullptr) members->push_back(numbers[0]);
    }
  }

  Index vertex(std::int64_t number) const {
    const std::optional<Index> found = nodes_.find(number);
    if (!found) text_.fail("the node " + std::to_string(number) + " does not exist");
    return *found;
  }

  void add(const ElementType& type, const std::array<Index, 10>& n, std::int64_t number) {
    const std::size_t before[] = {0, mesh_.segments.size(), mesh_.facets.size(), mesh_.tetrahedra.size()};
    const auto dimension = static_cast<std::size_t>(type.dimension);
    if (type.nodes == 10)
      add_second_order(mesh_, Tetrahedron{n[0], n[1], n[2], n[3]}, {n[4], n[5], n[6], n[7], n[8], n[9]}, 0);
    else if (type.dimension == 3)
      mesh_.add_tetrahedron({n[0], n[1], n[2], n[3]});
    else if (type.nodes == 6)
      add_second_order(mesh_, Triangle{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, 0);
    else if (type.dimension == 2)
      add_polygon(mesh_, std::span(n).first(type.nodes), 0,
                  [&](const std::string& reason) { text_.fail(reason); });
    else if (type.nodes == 3)  // Abaqus has the middle node between the ends
      add_second_order(mesh_, Segment{n[0], n[2]}, n[1], 0);
    else
      mesh_.add_segment({n[0], n[1]});
    const std::size_t after[] = {0, mesh_.segments.size(), mesh_.facets.size(), mesh_.tetrahedra.size()};
    numbers_.add(number);
    elements_.push_back({type.dimension, static_cast<Index>(before[dimension]),
                         static_cast<Index>(after[dimension] - before[dimension])});
  }

  void read_set(const Keyword& key) {
    const std::string& name = key.values.at("elset");
    const bool range = key.values.contains("generate");
    if (!sets_.contains(name)) order_.push_back(name);
    std::vector<std::int64_t>& members = sets_[name];
    for (; is_data(); next()) {
      const std::vector<std::string_view> fields = split(line_, ',');
      if (range) {
        add_range(fields, members);
        continue;
      }
      for (const std::string_view field : fields) {
        if (field.empty()) continue;
        if (field[0] >= '0' && field[0] <= '9')
          members.push_back(integer_of(text_, field, "an element's number"));
        else
          add_other_set(std::string(field), members);
      }
    }
  }

  void add_range(const std::vector<std::string_view>& fields, std::vector<std::int64_t>& members) {
    if (fields.size() < 2) text_.fail("GENERATE needs a first and a last element");
    const std::int64_t first = integer_of(text_, fields[0], "the first element"),
                       last = integer_of(text_, fields[1], "the last element");
    const std::int64_t step =
        fields.size() > 2 && !fields[2].empty() ? integer_of(text_, fields[2], "a step") : 1;
    if (step < 1 || first < 0 || last < first) text_.fail("a range that does not go up");
    // No more numbers than there are elements, which come first.
    const auto most = static_cast<std::int64_t>(elements_.size());
    if ((last - first) / step >= most) text_.fail("a range of more elements than there are");
    for (std::int64_t number = first; number <= last; number += step) members.push_back(number);
  }

  void add_other_set(const std::string& name, std::vector<std::int64_t>& members) {
    const std::vector<std::int64_t>* other = find_set(name);
    if (other == nullptr) text_.fail("the set " + in_quotes(name) + " does not exist");
    if (members.size() + other->size() > 16 * elements_.size() + 16)
      text_.fail("sets of more elements than there are");
    const std::vector<std::int64_t> copy = *other;
    members.insert(members.end(), copy.begin(), copy.end());
  }

  [[nodiscard]] const std::vector<std::int64_t>* find_set(const std::string& name) const {
    for (const auto* sets : {&sets_, &own_sets_})
      for (const auto& [known, members] : *sets)
        if (lower(known) == lower(name)) return &members;
    return nullptr;
  }

  struct Side {
    std::string_view element, side;
    std::size_t position;
  };

  void read_surface(const std::string& name) {
    auto& sides = surfaces_[name];
    if (sides.empty()) surface_order_.push_back(name);
    for (; is_data(); next()) {
      const std::vector<std::string_view> fields = split(line_, ',');
      sides.push_back({fields[0], fields.size() > 1 ? fields[1] : std::string_view(), text_.last()});
    }
  }

  void finish_numbers() {
    if (const auto twice = nodes_.finish()) fail_twice("node", *twice);
    if (const auto twice = numbers_.finish()) fail_twice("element", *twice);
    markers_.assign(mesh_.facets.size(), 0);
  }

  [[noreturn]] void fail_twice(const char* what, std::int64_t number) const {
    throw FileError(text_.source().path, "",
                    "the " + std::string(what) + " " + std::to_string(number) + " is there twice");
  }

  /// Sides of tetrahedra become facets, and those of shells give these their marker.
  void make_surfaces() {
    if (surface_order_.empty()) return;
    for (Index f = 0; f < mesh_.facets.size(); ++f) facet_of_.emplace(ascending(mesh_.facets[f]), f);
    for (const std::string& name : surface_order_) {
      const int id = markers_by_name_.id_of(name);
      for (const Side& side : surfaces_[name]) {
        if (!side.element.empty() && side.element[0] >= '0' && side.element[0] <= '9') {
          text_.seek(side.position);
          add_side(integer_of(text_, side.element, "an element's number"), side, id);
          continue;
        }
        const std::vector<std::int64_t>* set = find_set(std::string(side.element));
        if (set == nullptr)
          text_.fail_at(side.position, "the set " + in_quotes(side.element) + " does not exist");
        for (const std::int64_t number : *set) add_side(number, side, id);
      }
    }
  }

  void add_side(std::int64_t number, const Side& side, int id) {
    const std::optional<Index> found = numbers_.find(number);
    if (!found) text_.fail_at(side.position, "the element " + std::to_string(number) + " does not exist");
    const Element& element = elements_[*found];
    if (element.dimension == 2) {
      for (Index k = 0; k < element.count; ++k) markers_[element.entity + k] = id;
      return;
    }
    const std::string name = lower(side.side);
    if (element.dimension != 3 || name.size() != 2 || name[0] != 's' || name[1] < '1' || name[1] > '4')
      text_.fail_at(side.position,
                    "expected a side S1 to S4 of a tetrahedron, found " + in_quotes(side.side));
    const std::size_t opposite = kOpposite[static_cast<std::size_t>(name[1] - '1')];
    const Tetrahedron& corners = mesh_.tetrahedra[element.entity];
    const auto& outward = kOutwardFaces[opposite];
    const Triangle facet{corners[outward[0]], corners[outward[1]], corners[outward[2]]};
    const auto [there, fresh] = facet_of_.emplace(ascending(facet), static_cast<Index>(mesh_.facets.size()));
    if (fresh) {
      add_facet(element.entity, outward, facet);
      markers_.push_back(0);
    }
    markers_[there->second] = id;
  }

  /// With the nodes on its edges, where the tetrahedron has some.
  void add_facet(Index tetrahedron, const std::array<std::size_t, 3>& outward, const Triangle& facet) {
    if (tetrahedron >= mesh_.mids.tetrahedra.size() || mesh_.mids.tetrahedra[tetrahedron][0] == no_entity)
      return mesh_.add_facet(facet);
    constexpr std::size_t kEdge[4][4] = {{0, 0, 2, 3}, {0, 0, 1, 4}, {2, 1, 0, 5}, {3, 4, 5, 0}};
    const std::array<Index, 6>& mids = mesh_.mids.tetrahedra[tetrahedron];
    add_second_order(mesh_, facet,
                     {mids[kEdge[outward[0]][outward[1]]], mids[kEdge[outward[1]][outward[2]]],
                      mids[kEdge[outward[0]][outward[2]]]},
                     0);
  }

  /// The largest set first, so that the smaller ones count; at last those that elements are listed in.
  void apply_sets() {
    std::vector<int> regions(mesh_.tetrahedra.size(), 0), segments(mesh_.segments.size(), 0);
    std::vector<int> shells(mesh_.facets.size(), 0);
    const auto apply = [&](const std::string& name, const std::vector<std::int64_t>& members) {
      std::array<int, 4> id{};
      for (const std::int64_t number : members) {
        const std::optional<Index> found = numbers_.find(number);
        if (!found)
          throw FileError(
              text_.source().path, "",
              "the element " + std::to_string(number) + " of the set " + in_quotes(name) + " does not exist");
        const Element& element = elements_[*found];
        const auto d = static_cast<std::size_t>(element.dimension);
        NamedIds& ids = d == 3 ? regions_by_name_ : d == 2 ? markers_by_name_ : segments_by_name_;
        if (id[d] == 0) id[d] = ids.id_of(name);
        std::vector<int>& of = d == 3 ? regions : d == 2 ? shells : segments;
        for (Index k = 0; k < element.count; ++k) of[element.entity + k] = id[d];
      }
    };
    std::vector<std::string> by_size = order_;
    std::stable_sort(by_size.begin(), by_size.end(),
                     [&](const std::string& a, const std::string& b) { return size_of(a) > size_of(b); });
    for (const auto* sets : {&sets_, &own_sets_})
      for (const std::string& name : by_size)
        if (const auto found = sets->find(name); found != sets->end()) apply(name, found->second);
    for (std::size_t f = 0; f < markers_.size(); ++f)
      mesh_.facet_markers.add(f, markers_[f] != 0 ? markers_[f] : shells[f]);
    for (std::size_t t = 0; t < regions.size(); ++t) mesh_.regions.add(t, regions[t]);
    for (std::size_t s = 0; s < segments.size(); ++s) mesh_.segment_markers.add(s, segments[s]);
    mesh_.names.facets = markers_by_name_.take();
    mesh_.names.regions = regions_by_name_.take();
    mesh_.names.segments = segments_by_name_.take();
  }

  [[nodiscard]] std::size_t size_of(const std::string& name) const {
    const auto found = sets_.find(name);
    return found == sets_.end() ? 0 : found->second.size();
  }

  void tell_skipped() {
    std::string names;
    std::size_t count = 0;
    for (const auto& [name, blocks] : skipped_) {
      names += (names.empty() ? "*" : ", *") + name;
      count += blocks;
    }
    mesh_.leave_out(count, "blocks (" + names + ")", "block (" + names + ")");
  }

  TextReader text_;
  std::string_view line_;
  MeshData mesh_;
  Numbered nodes_, numbers_;
  std::vector<Element> elements_;
  std::map<std::string, std::vector<std::int64_t>> sets_, own_sets_;  ///< by *ELSET, and by *ELEMENT
  std::vector<std::string> order_, surface_order_;
  std::map<std::string, std::vector<Side>> surfaces_;
  std::map<Triangle, Index> facet_of_;
  std::vector<int> markers_;  ///< of facets, by surfaces
  NamedIds regions_by_name_{kRegionStem}, markers_by_name_{kFacetStem}, segments_by_name_{kSegmentStem};
  std::map<std::string, std::size_t> skipped_;
};

}  // namespace

MeshData read_inp(const Source& source) { return InpReader(source).read(); }

}  // namespace holdfast::io
