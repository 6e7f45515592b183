// Writes meshes of Ansys Fluent as text (user's guide, appendix "Mesh file format"): a zone of cells for each
// region, a zone of faces for each marker and one for all other inner faces. Comments keep the ids.
#include <algorithm>
#include <charconv>
#include <set>

#include "io/fluent.h"
#include "io/foam_mesh.h"
#include "io/formats.h"
#include "io/mesh_sets.h"
#include "io/solver_text.h"

namespace holdfast::io {
namespace {

constexpr NameRule kFluentNames{64, "_-."};

/// Cell zones and face zones have different names.
SolverLabels fluent_labels(const Volume& volume) {
  SolverLabels labels(volume, kFluentNames, kAnyId);
  std::set<std::string> taken;
  for (const auto& [id, name] : labels.regions.names) taken.insert(name);
  for (const auto& [id, name] : labels.facets.names) taken.insert(name);
  std::set<std::string> of_regions;
  for (const auto& [id, name] : labels.regions.names) of_regions.insert(name);
  for (auto& [id, name] : labels.facets.names) {
    if (!of_regions.contains(name)) continue;
    std::string other = name + "_surface";
    while (!taken.insert(other).second) other += '_';
    name = std::move(other);
    ++labels.facets.changed_names;
  }
  return labels;
}

/// A name that no zone has yet.
std::string free_name(std::string name, const SolverLabels& labels) {
  const auto is_taken = [&](const Labels& of) {
    return std::any_of(of.names.begin(), of.names.end(),
                       [&](const auto& entry) { return entry.second == name; });
  };
  while (is_taken(labels.regions) || is_taken(labels.facets)) name += '_';
  return name;
}

struct Hex {
  std::uint64_t value;
};
AtomicWriter& operator<<(AtomicWriter& out, Hex number) {
  char digits[16];
  const auto result = std::to_chars(digits, digits + sizeof digits, number.value, 16);
  return out << std::string_view(digits, static_cast<std::size_t>(result.ptr - digits));
}

/// A face as Fluent lists it: its corners turn as seen from the second cell.
struct Line {
  Triangle corners;
  std::array<std::uint64_t, 2> cells;  ///< from 1; 0: none
};

struct FaceZone {
  std::string name;
  std::vector<Line> faces;
  bool inside = true;  ///< every face is between two cells
};

class FluentWriter {
 public:
  FluentWriter(AtomicWriter& out, const Volume& volume, Watch& watch)
      : out_(out), volume_(volume), watch_(watch), labels_(fluent_labels(volume)) {}

  void write() {
    number_cells();
    const std::vector<FaceZone> zones = volume_.tetrahedra.empty() ? surface_zones() : face_zones();
    std::size_t faces = 0;
    for (const FaceZone& zone : zones) faces += zone.faces.size();
    out_ << "(0 \"mesh by Holdfast\")\n";
    for (const Labels* labels : {&labels_.regions, &labels_.facets})
      for (const auto& [id, name] : labels->names)
        out_ << "(0 \"" << labels->stem << ' ' << id << ' ' << name << "\")\n";
    out_ << "(2 3)\n(10 (0 1 " << Hex{volume_.vertices.size()} << " 0 3))\n(12 (0 1 "
         << Hex{volume_.tetrahedra.size()} << " 0 0))\n(13 (0 1 " << Hex{faces} << " 0 0))\n";
    write_nodes();
    write_cell_zones();
    write_face_zones(zones);
    for (const auto& [zone, type, name] : named_)
      out_ << "(45 (" << zone << ' ' << type << ' ' << name << ")())\n";
  }

 private:
  struct Named {
    int zone;
    std::string_view type;
    std::string name;
  };

  /// The cells of a region have consecutive numbers.
  void number_cells() {
    number_.resize(volume_.tetrahedra.size());
    regions_ = labels_.regions.sets();
    std::uint64_t next = 0;
    for (const auto& [id, cells] : regions_)
      for (const std::size_t cell : cells) number_[cell] = ++next;
  }

  /// Facets turn as seen from outside, or from the cell before them; Fluent's faces the other way round.
  Line line_of(const FoamFace& face) const {
    Triangle outwards = face.corners;
    bool is_turned = false;
    if (face.facet != no_entity) {
      const Triangle& facet = volume_.facets[face.facet];
      is_turned = !is_rotation(outwards, facet);
      if (!is_turned || face.neighbour != no_entity) outwards = facet;
    }
    Line line{{outwards[2], outwards[1], outwards[0]}, {number_[face.owner], 0}};
    if (face.neighbour != no_entity) line.cells[1] = number_[face.neighbour];
    if (is_turned && face.neighbour != no_entity) std::swap(line.cells[0], line.cells[1]);
    return line;
  }
  static bool is_rotation(const Triangle& a, const Triangle& b) {
    const auto first = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
    return b[(first + 1) % 3] == a[1];
  }

  std::vector<FaceZone> face_zones() const {
    const FoamMesh mesh = foam_mesh(volume_, watch_);
    FaceZone rest_inside{free_name("interior", labels_), {}};
    FaceZone rest{free_name(std::string(kRestOfFluent), labels_), {}, false};
    std::map<int, FaceZone> marked;
    for (const auto* faces : {&mesh.inside, &mesh.boundary})
      for (const FoamFace& face : *faces) {
        const bool inside = face.neighbour != no_entity;
        FaceZone& zone = face.facet != no_entity ? marked[labels_.facets.ids[face.facet]]
                         : inside                ? rest_inside
                                                 : rest;
        zone.inside = zone.inside && inside;
        zone.faces.push_back(line_of(face));
      }
    std::vector<FaceZone> zones{std::move(rest_inside)};
    for (auto& [id, zone] : marked) {
      zone.name = labels_.facets.names.at(id);
      zones.push_back(std::move(zone));
    }
    zones.push_back(std::move(rest));
    std::erase_if(zones, [](const FaceZone& zone) { return zone.faces.empty(); });
    return zones;
  }

  /// Of a surface: faces without cells.
  std::vector<FaceZone> surface_zones() const {
    std::vector<FaceZone> zones;
    for (const auto& [id, facets] : labels_.facets.sets()) {
      FaceZone zone{labels_.facets.names.at(id), {}, false};
      for (const std::size_t f : facets) zone.faces.push_back({volume_.facets[f], {0, 0}});
      zones.push_back(std::move(zone));
    }
    return zones;
  }

  void write_nodes() {
    out_ << "(10 (" << zone_++ << " 1 " << Hex{volume_.vertices.size()} << " 1 3)(\n";
    for (const Point& p : volume_.vertices) {
      watch_.beat();
      out_ << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    }
    out_ << "))\n";
  }

  void write_cell_zones() {
    std::uint64_t first = 1;
    for (const auto& [id, cells] : regions_) {
      out_ << "(12 (" << Hex{static_cast<std::uint64_t>(zone_)} << ' ' << Hex{first} << ' '
           << Hex{first + cells.size() - 1} << " 1 2))\n";
      named_.push_back({zone_++, "fluid", labels_.regions.names.at(id)});
      first += cells.size();
    }
  }

  void write_face_zones(const std::vector<FaceZone>& zones) {
    std::uint64_t first = 1;
    for (const FaceZone& zone : zones) {
      out_ << "(13 (" << Hex{static_cast<std::uint64_t>(zone_)} << ' ' << Hex{first} << ' '
           << Hex{first + zone.faces.size() - 1} << (zone.inside ? " 2" : " 3") << " 3)(\n";
      for (const Line& face : zone.faces) {
        watch_.beat();
        for (const Index v : face.corners) out_ << Hex{std::uint64_t{v} + 1} << ' ';
        out_ << Hex{face.cells[0]} << ' ' << Hex{face.cells[1]} << '\n';
      }
      out_ << "))\n";
      named_.push_back({zone_++, zone.inside ? "interior" : "wall", zone.name});
      first += zone.faces.size();
    }
  }

  AtomicWriter& out_;
  const Volume& volume_;
  Watch& watch_;
  SolverLabels labels_;
  std::map<int, std::vector<std::size_t>> regions_;  ///< the cells of each
  std::vector<std::uint64_t> number_;                ///< of each cell in the file
  int zone_ = 1;                                     ///< the next free number
  std::vector<Named> named_;
};

}  // namespace

void write_fluent(const std::filesystem::path& path, const Volume& volume, const WriteOptions&,
                  Watch& watch) {
  AtomicWriter out(path, &watch);
  FluentWriter(out, volume, watch).write();
  out.commit();
}

std::vector<Remark> not_in_fluent(const Volume& volume, const WriteOptions&) {
  constexpr std::string_view kFormat = "Fluent's format";
  std::vector<Remark> remarks;
  const SolverLabels labels = fluent_labels(volume);
  tell(labels.regions, kFormat, remarks);
  tell(labels.facets, kFormat, remarks);
  if (!volume.tetrahedra.empty()) {
    const auto sides = sides_of_facets(volume);
    const auto loose = static_cast<std::size_t>(std::count_if(
        sides.begin(), sides.end(), [](const SidesOfFacet& of) { return !of.behind && !of.front; }));
    if (loose > 0)
      remarks.push_back({RemarkKind::not_held, loose,
                         std::to_string(loose) + " facets are no faces of tetrahedra, and have no place in " +
                             std::string(kFormat)});
  }
  tell_left_out(volume, kFormat, false, false, remarks);
  return remarks;
}

}  // namespace holdfast::io
