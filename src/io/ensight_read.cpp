// Reads EnSight Gold, .case with its geometry file (EnSight user manual, "EnSight Gold casefile format"):
// each part is a region, a marker or both, under its number and description. Parts are joined where their
// nodes are at one place.
#include <algorithm>
#include <array>
#include <bit>

#include "io/cells.h"
#include "io/ensight_geo.h"
#include "io/fields.h"
#include "io/file_bytes.h"
#include "io/formats.h"
#include "io/labels.h"
#include "io/mid_nodes.h"
#include "io/named_files.h"
#include "io/polygon.h"
#include "text/count.h"

namespace holdfast::io {
namespace {

struct EnsightType {
  std::string_view name;
  std::size_t nodes, corners, dimension;
};
constexpr EnsightType kEnsightTypes[] = {
    {"point", 1, 1, 0},    {"bar2", 2, 2, 1},     {"bar3", 3, 2, 1},       {"tria3", 3, 3, 2},
    {"tria6", 6, 3, 2},    {"quad4", 4, 4, 2},    {"quad8", 8, 4, 2},      {"tetra4", 4, 4, 3},
    {"tetra10", 10, 4, 3}, {"pyramid5", 5, 5, 3}, {"pyramid13", 13, 5, 3}, {"penta6", 6, 6, 3},
    {"penta15", 15, 6, 3}, {"hexa8", 8, 8, 3},    {"hexa20", 20, 8, 3}};

/// The geometry file that a case names, of its first time step.
std::filesystem::path model_of(const Source& source) {
  TextReader text(source);
  std::string section, model, first = "0";
  while (!text.remaining().empty()) {
    const std::string_view line = trimmed(text.rest_of_line());
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) {
      if (!line.empty()) section = lower(line);
      continue;
    }
    const std::string key = lower(trimmed(line.substr(0, colon)));
    const std::vector<std::string_view> words = words_of(trimmed(line.substr(colon + 1)));
    if (words.empty()) continue;
    if (section == "format" && key == "type" && (words.size() < 2 || lower(words[1]) != "gold"))
      text.fail("a case of EnSight 6 or 5; only EnSight Gold is read");
    if (section == "geometry" && key == "model") {
      const auto is_number = [](std::string_view word) {
        return word.find_first_not_of("0123456789") == std::string_view::npos;
      };
      const auto name =
          std::find_if_not(words.begin(), words.end(), is_number);  // after the time and file set
      model = name == words.end() ? words.back() : *name;
    }
    if (section == "time" && (key == "filename start number" || key == "filename numbers")) first = words[0];
  }
  if (model.empty())
    throw FileError(source.path, "", "the case names no geometry (model: FILE); is it one of EnSight?");
  std::erase(model, '"');
  if (const std::size_t stars = model.find('*'); stars != std::string::npos) {
    const std::size_t count = model.find_last_of('*') - stars + 1;
    first.insert(0, count > first.size() ? count - first.size() : 0, '0');
    model.replace(stars, count, first);
  }
  return source.path.parent_path() / model;
}

class EnsightReader {
 public:
  explicit EnsightReader(const Source& source) : geo_(source), mesh_(source) {}

  MeshData read() {
    read_head();
    while (!geo_.at_end() && !keyword_.empty()) read_part();
    if (mesh_.vertices.empty()) geo_.fail("the geometry has no nodes");
    join_nodes();
    for (const Element& element : elements_) add(element);
    mesh_.leave_out(ghosts_, "ghost cells", "ghost cell");
    mesh_.leave_out(points_, "point elements", "point element");
    mesh_.names = {markers_.take(), regions_.take(), lines_.take(), {}};
    return std::move(mesh_);
  }

 private:
  struct Element {
    std::size_t corners, dimension;
    std::size_t first, count;  ///< in `nodes_`
    int part;
    std::size_t place;
  };

  /// Two lines of description, whether ids are given, and the first "part".
  void read_head() {
    std::string_view line = geo_.line("a description");
    if (lower(line).starts_with("begin time step")) line = geo_.line("a description");
    static_cast<void>(geo_.line("a description"));
    has_node_ids_ = read_ids("node id");
    has_element_ids_ = read_ids("element id");
    keyword_ = geo_.keyword("part");
    if (lower(keyword_).starts_with("extents")) {
      for (int i = 0; i < 6; ++i) static_cast<void>(geo_.real("an extent"));
      keyword_ = geo_.keyword("part");
    }
    if (keyword_ != "part") geo_.fail("expected 'part', found " + in_quotes(keyword_));
  }

  bool read_ids(const std::string& what) {
    const std::string line = lower(geo_.keyword(what));
    if (!line.starts_with(what)) geo_.fail("expected '" + what + "', found " + in_quotes(line));
    return line.find("given") != std::string::npos || line.find("ignore") != std::string::npos;
  }

  /// Of the part whose keyword was read; reads the keyword after it.
  void read_part() {
    part_ = static_cast<int>(geo_.part_number() & 0x7FFFFFFF);
    const std::string description = cleaned_name(geo_.line("the description of a part"));
    const std::string_view kind = geo_.keyword("coordinates");
    if (lower(kind) != "coordinates")
      geo_.fail("parts with " + in_quotes(kind) + " are not read; save them as unstructured");
    const std::size_t before = mesh_.vertices.size();
    const std::size_t count = geo_.count("the number of nodes", 3);
    if (has_node_ids_) geo_.skip_integers(count);
    mesh_.vertices.resize(before + count);
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < count; ++i) mesh_.vertices[before + i][axis] = geo_.real("a coordinate");
    if (mesh_.vertices.size() >= no_entity) geo_.fail("more nodes than 32 bits count");
    keyword_ = {};
    while (!geo_.at_end()) {
      const std::string_view word = geo_.keyword("an element's type");
      if (word == "part") {
        keyword_ = word;
        break;
      }
      if (lower(word).starts_with("end time step")) break;
      read_elements(word, before, count, description);
    }
  }

  void read_elements(std::string_view word, std::size_t before, std::size_t nodes,
                     const std::string& description) {
    const bool is_ghost = word.starts_with("g_");
    const std::string_view name = is_ghost ? word.substr(2) : word;
    const auto* const type = std::find_if(std::begin(kEnsightTypes), std::end(kEnsightTypes),
                                          [&](const EnsightType& t) { return t.name == name; });
    const bool is_polygon = name == "nsided";
    if (type == std::end(kEnsightTypes) && !is_polygon)
      geo_.fail("elements of the type " + in_quotes(word) + " are not read");
    const std::size_t count = geo_.count("the number of elements", is_polygon ? 1 : type->nodes);
    if (has_element_ids_) geo_.skip_integers(count);
    std::vector<std::size_t> corners(is_polygon ? count : 0);
    for (std::size_t& n : corners) n = geo_.count("a number of corners", 1);
    const std::size_t dimension = is_polygon ? 2 : type->dimension;
    if (!is_ghost && count > 0) name_part(dimension, description);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t of_element = is_polygon ? corners[i] : type->nodes;
      const std::size_t first = nodes_.size();
      std::size_t place = 0;
      for (std::size_t k = 0; k < of_element; ++k) {
        const std::int64_t node = geo_.integer("a node");
        if (node < 1 || static_cast<std::uint64_t>(node) > nodes)
          geo_.fail("names node " + std::to_string(node) + ", but the part has " + std::to_string(nodes));
        nodes_.push_back(static_cast<Index>(before + static_cast<std::size_t>(node) - 1));
        place = geo_.place();
      }
      if (is_ghost) {
        nodes_.resize(first);
        ++ghosts_;
      } else {
        elements_.push_back(
            {is_polygon ? of_element : type->corners, dimension, first, of_element, part_, place});
      }
    }
  }

  void name_part(std::size_t dimension, const std::string& description) {
    if (dimension > 0)
      (dimension == 3 ? regions_ : dimension == 2 ? markers_ : lines_).set(part_, description);
  }

  /// Nodes of different parts at one place become one.
  void join_nodes() {
    const auto key = [&](Index v) {
      std::array<std::uint64_t, 3> bits{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double x = mesh_.vertices[v][axis];
        bits[axis] = std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x);
      }
      return bits;
    };
    std::vector<std::pair<std::array<std::uint64_t, 3>, Index>> sorted;
    for (Index v = 0; v < mesh_.vertices.size(); ++v) sorted.emplace_back(key(v), v);
    std::sort(sorted.begin(), sorted.end());
    std::vector<Index> first(mesh_.vertices.size());
    for (std::size_t i = 0, j = 0; i < sorted.size(); i = j)
      for (; j < sorted.size() && sorted[j].first == sorted[i].first; ++j)
        first[sorted[j].second] = sorted[i].second;
    std::vector<Index> number(first.size());
    std::vector<Point> kept;
    for (Index v = 0; v < first.size(); ++v) {
      number[v] = first[v] == v ? static_cast<Index>(kept.size()) : number[first[v]];
      if (first[v] == v) kept.push_back(mesh_.vertices[v]);
    }
    const std::size_t joined = first.size() - kept.size();
    for (Index& node : nodes_) node = number[node];
    mesh_.vertices = std::move(kept);
    if (joined > 0)
      mesh_.remarks.push_back(
          {RemarkKind::left_out, joined,
           counted(joined, "node of parts is", "nodes of parts are") + " joined to one at the same place"});
  }

  void add(const Element& element) {
    beat(mesh_.watch);
    const std::span<const Index> n = std::span<const Index>(nodes_).subspan(element.first, element.count);
    if (element.dimension == 0) return void(++points_);
    if (element.dimension == 1) {
      const int id = lines_.resolve(element.part);
      if (n.size() == 3) return add_second_order(mesh_, Segment{n[0], n[1]}, n[2], id);
      return mesh_.add_segment({n[0], n[1]}, id);
    }
    if (element.dimension == 2) {
      const int id = markers_.resolve(element.part);
      if (element.corners == 3 && n.size() == 6)
        return add_second_order(mesh_, Triangle{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, id);
      add_polygon(mesh_, n.first(element.corners), id,
                  [&](const std::string& reason) { geo_.fail_at(element.place, reason); });
      return add_no_corners(mesh_, n.subspan(element.corners));
    }
    const int id = regions_.resolve(element.part);
    if (element.corners > 4) return add_cell(mesh_, n, element.corners, id);
    if (n.size() == 10)
      return add_second_order(mesh_, Tetrahedron{n[0], n[1], n[2], n[3]},
                              {n[4], n[5], n[6], n[7], n[8], n[9]}, id);
    mesh_.add_tetrahedron({n[0], n[1], n[2], n[3]}, id);
  }

  EnsightGeo geo_;
  MeshData mesh_;
  bool has_node_ids_ = false, has_element_ids_ = false;
  std::string_view keyword_;  ///< "part" if another part follows
  int part_ = 0;
  std::vector<Index> nodes_;  ///< of all elements
  std::vector<Element> elements_;
  std::size_t ghosts_ = 0, points_ = 0;
  NamedIds regions_{kRegionStem}, markers_{kFacetStem}, lines_{kSegmentStem};
};

}  // namespace

MeshData read_ensight(const Source& source) {
  const std::filesystem::path model = model_of(source);
  const FileBytes bytes(model, source.watch);
  Source geometry{model, bytes.view(), source.finite, source.watch, source.tolerance, source.keeps_polygons};
  return EnsightReader(geometry).read();
}

std::vector<std::filesystem::path> ensight_files(const std::filesystem::path& path) {
  return with_named_files(path, [](const Source& source) { return std::vector{model_of(source)}; });
}

}  // namespace holdfast::io
