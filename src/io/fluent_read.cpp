// Reads meshes of Ansys Fluent (user's guide, appendix "Mesh file format"), .msh and .cas, in text or with
// binary sections. Face zones are the markers, cell zones the regions; cells are found by their faces.
#include <algorithm>
#include <charconv>
#include <map>

#include "io/cells.h"
#include "io/fluent.h"
#include "io/fluent_cells.h"
#include "io/fluent_text.h"
#include "io/labels.h"
#include "io/polygon.h"
#include "io/turn.h"

namespace holdfast::io {
namespace {

constexpr std::uint64_t kInterior = 2, kParents = 31;  // types of face zones
constexpr std::uint64_t kInactive = 32;                // of a cell zone
constexpr int kBinary = 2000, kWide = 3000;            // added to the index of a section

/// Whether a zone of inner faces has a name as programs give it, not one that a user gave to a surface.
bool is_usual_name_of_inside(std::string_view name) {
  return name.empty() || name.find("interior") != std::string_view::npos || name.starts_with("int_") ||
         name.starts_with("int-");
}

class FluentReader {
 public:
  explicit FluentReader(const Source& source) : text_(source), mesh_(source) {}

  MeshData read(bool as_volume) {
    while (!text_.at_end()) read_section();
    place_nodes();
    require_nodes();
    for (const auto& [zone, name] : zone_names_) name_zone(zone, name);
    for (const FaceZone& zone : face_zones_)
      if (is_surface(zone)) add_facets(zone);
    if (as_volume)
      add_cells();
    else
      mesh_.leave_out(cells_, "cells", "cell");
    mesh_.names.facets = facet_ids_.take();
    mesh_.names.regions = region_ids_.take();
    turn_if_all_are_turned(
        mesh_, "the faces of all cells are oriented outwards, not as in Fluent; the cells are turned");
    return std::move(mesh_);
  }

 private:
  struct NodeZone {
    std::uint64_t first;
    std::vector<Point> points;
    std::size_t position;
  };
  struct CellZone {
    int id;
    std::uint64_t first, last;
    bool active;
    std::size_t position;
  };
  struct Face {
    std::size_t begin;           ///< in `corners_`
    std::array<Index, 2> cells;  ///< from 1; 0: none. The corners turn as seen from the second
  };
  struct FaceZone {
    int id;
    std::uint64_t type;
    std::size_t begin, end;  ///< in `faces_`
    std::size_t position;
  };
  struct Header {
    int zone = 0;
    std::uint64_t first = 0, last = 0, type = 0, kind = 0;
    std::size_t position = 0;
  };

  void read_section() {
    text_.open("a section");
    const std::string_view word = text_.word("the index of a section");
    int index = -1;
    static_cast<void>(std::from_chars(word.data(), word.data() + word.size(), index));
    const bool binary = index >= kBinary && index < kWide + 1000;
    switch (binary ? index % 1000 : index) {
      case 0:
        if (text_.peek() == '"')
          read_id_comment(text_.word("a comment"), std::array{&facet_ids_, &region_ids_});
        return text_.skip_list();
      case 2:
        dimension_ = text_.decimal("the dimension");
        if (dimension_ != 3)
          text_.fail("a mesh of " + std::to_string(dimension_) + " dimensions; only those of 3 are read");
        return text_.skip_list();
      case 4:
        return read_machine();
      case 10:
        return read_nodes(index);
      case 12:
        return read_cells(index);
      case 13:
        return read_faces(index);
      case 39:
      case 45:
        return read_zone_name();
      default:
        return binary ? text_.skip_binary() : text_.skip_list();
    }
  }

  /// The machine that wrote binary sections: 60 is the byte order of Intel's.
  void read_machine() {
    if (text_.peek() == '(') {
      text_.open("the machine");
      text_.set_order(text_.decimal("the machine") == 60 ? std::endian::little : std::endian::big);
      text_.skip_list();
    }
    text_.skip_list();
  }

  Header read_header() {
    text_.open("the header of a section");
    Header header;
    header.position = text_.position();
    header.zone = static_cast<int>(text_.hexadecimal("a zone") & 0x7FFFFFFF);
    header.first = text_.hexadecimal("the first number");
    header.last = text_.hexadecimal("the last number");
    if (text_.peek() != ')') header.type = text_.hexadecimal("a type");
    if (text_.peek() != ')') header.kind = text_.hexadecimal("a type");
    text_.skip_list();
    return header;
  }

  /// Whether a body follows; a section without one, or with zone 0, announces totals.
  bool begins_body(const Header& header, int index, std::size_t bytes) {
    if (header.zone == 0 || text_.peek() != '(') {
      text_.skip_list();
      return false;
    }
    text_.open("the body of a section");
    text_.begin_body(index >= kBinary ? bytes : 0);
    return true;
  }

  void read_nodes(int index) {
    const Header header = read_header();
    if (!begins_body(header, index, index >= kWide ? 8 : 4)) return;
    const std::size_t bytes_each = index < kBinary ? 6 : 3 * (index >= kWide ? 8 : 4);
    NodeZone zone{header.first, {}, header.position};
    zone.points.resize(text_.count(header.first, header.last, bytes_each, "nodes"));
    for (Point& point : zone.points)
      for (double& x : point) x = text_.real("a coordinate");
    text_.end_body();
    node_zones_.push_back(std::move(zone));
  }

  void read_cells(int index) {
    const Header header = read_header();
    if (header.zone == 0) {
      if (text_.peek() != ')') static_cast<void>(text_.word("a type"));
      return text_.skip_list();
    }
    if (header.first < 1 || header.last >= no_entity || header.last + 1 < header.first)
      text_.fail("cells from " + std::to_string(header.first) + " to " + std::to_string(header.last) +
                 " are none that 32 bits count");
    cell_zones_.push_back({header.zone, header.first, header.last,
                           header.type != 0 && header.type != kInactive, header.position});
    if (index >= kBinary && text_.peek() == '(') return text_.skip_binary();
    text_.skip_list();
  }

  void read_faces(int index) {
    const Header header = read_header();
    if (!begins_body(header, index, 4)) return;
    const std::size_t corners =
        header.kind == 3 || header.kind == 4 ? header.kind : 0;  // 0: each face says it
    const std::size_t least = (corners > 0 ? corners : 4) + 2;
    const std::size_t count =
        text_.count(header.first, header.last, index < kBinary ? 2 * least : 4 * least, "faces");
    // Some programs write indices of 64 bits.
    if (index >= kWide && corners > 0 && text_.size_of_binary() >= 8 * least * count) text_.begin_body(8);
    FaceZone zone{header.zone, header.type, faces_.size(), 0, header.position};
    for (std::size_t i = 0; i < count; ++i) read_face(corners);
    zone.end = faces_.size();
    text_.end_body();
    face_zones_.push_back(zone);
  }

  void read_face(std::size_t corners) {
    const std::uint64_t count = corners > 0 ? corners : text_.index("a number of corners");
    if (count < 3 || count > text_.source().bytes.size())
      text_.fail("a face of " + std::to_string(count) + " corners");
    Face face{corners_.size(), {}};
    for (std::uint64_t k = 0; k < count; ++k) corners_.push_back(number("a node of a face"));
    for (Index& cell : face.cells) cell = number("a cell of a face");
    faces_.push_back(face);
  }

  Index number(std::string_view what) {
    const std::uint64_t value = text_.index(what);
    if (value >= no_entity) text_.fail(std::string(what) + " is beyond 32 bits: " + std::to_string(value));
    return static_cast<Index>(value);
  }

  /// (ZONE TYPE NAME ...)
  void read_zone_name() {
    if (text_.peek() == '(') {
      text_.open("a zone");
      const std::int64_t zone = text_.decimal("a zone");
      static_cast<void>(text_.word("the type of a zone"));
      if (zone > 0 && zone < no_entity / 2 && text_.peek() != ')')
        zone_names_[static_cast<int>(zone)] = text_.word("the name of a zone");
      text_.skip_list();
    }
    text_.skip_list();
  }

  void place_nodes() {
    std::sort(node_zones_.begin(), node_zones_.end(),
              [](const NodeZone& a, const NodeZone& b) { return a.first < b.first; });
    for (NodeZone& zone : node_zones_) {
      if (zone.first != mesh_.vertices.size() + 1)
        text_.fail_at(zone.position, "nodes from " + std::to_string(zone.first) +
                                         " on, but those before end with " +
                                         std::to_string(mesh_.vertices.size()));
      mesh_.vertices.insert(mesh_.vertices.end(), zone.points.begin(), zone.points.end());
      zone.points = {};
    }
    if (mesh_.vertices.empty()) throw FileError(text_.source().path, "", "the file has no nodes");
    for (const CellZone& zone : cell_zones_)
      if (zone.active) cells_ += static_cast<std::size_t>(zone.last + 1 - zone.first);
  }

  /// Nodes are numbered from 1; here from 0.
  void require_nodes() {
    for (const FaceZone& zone : face_zones_)
      for (std::size_t f = zone.begin; f < zone.end; ++f)
        for (std::size_t k = faces_[f].begin; k < end_of(f); ++k) {
          if (corners_[k] < 1 || corners_[k] > mesh_.vertices.size())
            text_.fail_at(zone.position, "a face of this zone names node " + std::to_string(corners_[k]) +
                                             ", but there are " + std::to_string(mesh_.vertices.size()));
          --corners_[k];
        }
  }

  [[nodiscard]] std::size_t end_of(std::size_t face) const {
    return face + 1 < faces_.size() ? faces_[face + 1].begin : corners_.size();
  }
  [[nodiscard]] std::span<const Index> corners_of(std::size_t face) const {
    return std::span(corners_).subspan(faces_[face].begin, end_of(face) - faces_[face].begin);
  }

  void name_zone(int zone, const std::string& name) {
    const auto is = [zone](const auto& other) { return other.id == zone; };
    if (std::any_of(cell_zones_.begin(), cell_zones_.end(), is)) region_ids_.set(zone, name);
    const auto faces = std::find_if(face_zones_.begin(), face_zones_.end(), is);
    if (faces != face_zones_.end() && is_surface(*faces) && !is_rest(name)) facet_ids_.set(zone, name);
  }

  /// Whether a zone has the faces that nobody named.
  [[nodiscard]] bool is_rest(const std::string& name) const {
    return name.starts_with(kRestOfFluent) && !facet_ids_.has(name);
  }

  [[nodiscard]] bool is_surface(const FaceZone& zone) const {
    if (zone.type == kParents) return false;
    if (zone.type != kInterior) return true;
    const auto name = zone_names_.find(zone.id);
    return name != zone_names_.end() &&
           (facet_ids_.has(name->second) || !is_usual_name_of_inside(name->second));
  }

  /// Facets face away from the first cell: outwards on the boundary.
  void add_facets(const FaceZone& zone) {
    const auto name = zone_names_.find(zone.id);
    const int marker = name != zone_names_.end() && is_rest(name->second) ? 0 : facet_ids_.resolve(zone.id);
    std::vector<Index> corners;
    for (std::size_t f = zone.begin; f < zone.end; ++f) {
      beat(mesh_.watch);
      corners.assign(corners_of(f).begin(), corners_of(f).end());
      if (faces_[f].cells[0] != 0) std::reverse(corners.begin(), corners.end());
      add_polygon(mesh_, corners, marker,
                  [&](const std::string& reason) { text_.fail_at(zone.position, reason); });
    }
  }

  void add_cells() {
    std::sort(cell_zones_.begin(), cell_zones_.end(),
              [](const CellZone& a, const CellZone& b) { return a.first < b.first; });
    const std::size_t last = require_cells();
    std::vector<std::size_t> begin(last + 2, 0);
    const auto for_each = [&](auto&& use) {
      for (const FaceZone& zone : face_zones_)
        if (zone.type != kParents)
          for (std::size_t f = zone.begin; f < zone.end; ++f)
            for (const std::size_t side : {0U, 1U})
              if (faces_[f].cells[side] != 0) use(faces_[f].cells[side], 2 * f + side);
    };
    for_each([&](Index cell, std::size_t) { ++begin[cell + 1]; });
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    std::vector<std::size_t> sides(begin.back()), next(begin.begin(), begin.end() - 1);
    for_each([&](Index cell, std::size_t side) { sides[next[cell]++] = side; });
    for (const CellZone& zone : cell_zones_) {
      if (!zone.active) continue;
      const int region = region_ids_.resolve(zone.id);
      for (std::uint64_t cell = zone.first; cell <= zone.last; ++cell)
        add_cell_of(std::span(sides).subspan(begin[cell], begin[cell + 1] - begin[cell]), region, zone, cell);
    }
  }

  /// Throws unless the zones of cells have those that the faces name, and could have faces enough. Returns
  /// the last.
  std::size_t require_cells() {
    std::uint64_t last = 0;
    for (const CellZone& zone : cell_zones_) {
      if (zone.first != last + 1)
        text_.fail_at(zone.position, "cells from " + std::to_string(zone.first) +
                                         " on, but those before end with " + std::to_string(last));
      last = zone.last;
    }
    if (last > 2 * faces_.size())
      text_.fail_at(cell_zones_.back().position, std::to_string(last) + " cells, but only " +
                                                     std::to_string(faces_.size()) +
                                                     " faces; the file is truncated or damaged");
    for (const FaceZone& zone : face_zones_)
      for (std::size_t f = zone.begin; f < zone.end; ++f)
        for (const Index cell : faces_[f].cells)
          if (cell > last)
            text_.fail_at(zone.position, "a face of this zone names cell " + std::to_string(cell) +
                                             ", but there are " + std::to_string(last));
    return static_cast<std::size_t>(last);
  }

  void add_cell_of(std::span<const std::size_t> sides, int region, const CellZone& zone,
                   std::uint64_t number) {
    beat(mesh_.watch);
    std::array<FaceOfCell, 6> faces{};
    bool fits = sides.size() >= 4 && sides.size() <= faces.size();
    for (std::size_t i = 0; fits && i < sides.size(); ++i) {
      const std::span<const Index> corners = corners_of(sides[i] / 2);
      fits = corners.size() <= 4;
      if (!fits) break;
      std::copy(corners.begin(), corners.end(), faces[i].of.begin());
      faces[i].count = corners.size();
      if (sides[i] % 2 == 1)
        std::reverse(faces[i].of.begin(), faces[i].of.begin() + static_cast<std::ptrdiff_t>(faces[i].count));
    }
    const auto cell =
        fits ? corners_of_cell(std::span<const FaceOfCell>(faces).first(sides.size())) : std::nullopt;
    if (!cell)
      text_.fail_at(zone.position, "cell " + std::to_string(number) + " of this zone, with " +
                                       std::to_string(sides.size()) +
                                       " faces, is no tetrahedron, pyramid, prism or hexahedron");
    if (cell->count == 4)
      return mesh_.add_tetrahedron({cell->of[0], cell->of[1], cell->of[2], cell->of[3]}, region);
    add_cell(mesh_, cell->corners(), cell->count, region);
  }

  FluentText text_;
  MeshData mesh_;
  std::int64_t dimension_ = 3;
  std::vector<NodeZone> node_zones_;
  std::vector<CellZone> cell_zones_;
  std::vector<FaceZone> face_zones_;
  std::vector<Face> faces_;
  std::vector<Index> corners_;  ///< of all faces
  std::size_t cells_ = 0;       ///< that are active
  std::map<int, std::string> zone_names_;
  NamedIds facet_ids_{kFacetStem}, region_ids_{kRegionStem};
};

}  // namespace

bool is_fluent(std::string_view bytes) {
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  return start != std::string_view::npos && bytes[start] == '(';
}

MeshData read_fluent(const Source& source) { return FluentReader(source).read(true); }
MeshData read_fluent_surface(const Source& source) { return FluentReader(source).read(false); }

}  // namespace holdfast::io
