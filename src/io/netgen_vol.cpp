// Netgen's .vol (Netgen, NGSolve: the text form of its meshes). The second and third corners of its
// tetrahedra are swapped.
#include <algorithm>

#include "io/cells.h"
#include "io/fields.h"
#include "io/mid_nodes.h"
#include "io/polygon.h"
#include "io/solver_text.h"

namespace holdfast::io {
namespace {

/// Names are words. Netgen allocates arrays as long as the largest id.
constexpr NameRule kVolNames{255, "!$%&'()*+,-./:;<=>?@[]^_`{|}~", false, true, false, true};
constexpr IdRule kVolIds{true, 1000000};

class VolReader {
 public:
  explicit VolReader(const Source& source) : text_(source) {}

  MeshData read() {
    if (text_.word("mesh3d") != "mesh3d") text_.fail("not a Netgen mesh: it does not start with mesh3d");
    while (!text_.at_end()) {
      const std::string section = lower(text_.word("a section"));
      if (section == "endmesh") break;
      read_section(section);
    }
    add_entities();
    mesh_.leave_out(skipped_, "sections of other kinds", "section of another kind");
    return std::move(mesh_);
  }

 private:
  struct Entity {
    int id;
    std::vector<std::int64_t> nodes;  ///< from 1
    std::size_t position;
  };

  void read_section(const std::string& section) {
    if (section == "dimension") {
      if (text_.integer("the dimension") != 3) text_.fail("the dimension is not 3");
    } else if (section == "geomtype") {
      static_cast<void>(text_.integer("a geometry type"));
    } else if (section == "surfaceelements" || section == "surfaceelementsgi" ||
               section == "surfaceelementsuv") {
      read_entities(facets_, 5, 1, 4);
    } else if (section == "volumeelements") {
      read_entities(tetrahedra_, 2, 0, 1);
    } else if (section == "edgesegmentsgi2" || section == "edgesegmentsgi" || section == "edgesegments") {
      read_segments();
    } else if (section == "points") {
      const std::size_t count = text_.count("the number of points", 6);
      for (std::size_t i = 0; i < count; ++i) mesh_.vertices.push_back(text_.point());
    } else if (section == "materials") {
      read_names(regions_);
    } else if (section == "bcnames") {
      read_names(markers_);
    } else if (section == "cd2names") {
      read_names(curves_);
    } else {
      skip_section(section);
    }
  }

  /// Reads lines of numbers, among them the id and the number of nodes, followed by the nodes.
  void read_entities(std::vector<Entity>& entities, std::size_t before, std::size_t id, std::size_t nodes) {
    const std::size_t count = text_.count("the number of elements", 8);
    for (std::size_t i = 0; i < count; ++i) {
      Entity entity{0, {}, 0};
      std::int64_t size = 0;
      for (std::size_t k = 0; k < before; ++k) {
        const int value = text_.tag("a number of an element");
        if (k == id) entity.id = value;
        if (k == nodes) size = value;
      }
      entity.position = text_.last();
      if (size < 1 || size > 20) text_.fail("an element of " + std::to_string(size) + " nodes");
      for (std::int64_t k = 0; k < size; ++k) entity.nodes.push_back(text_.integer("a point's number"));
      text_.skip_line();  // geometry parameters may follow
      entities.push_back(std::move(entity));
    }
  }

  void read_segments() {
    const std::size_t count = text_.count("the number of segments", 8);
    for (std::size_t i = 0; i < count; ++i) {
      Entity entity{text_.tag("an edge's number"), {}, 0};
      static_cast<void>(text_.integer("a number of an edge"));
      entity.position = text_.last();
      for (int k = 0; k < 2; ++k) entity.nodes.push_back(text_.integer("a point's number"));
      text_.skip_line();
      segments_.push_back(std::move(entity));
    }
  }

  void read_names(NamedIds& names) {
    const std::size_t count = text_.count("the number of names", 2);
    for (std::size_t i = 0; i < count; ++i) {
      const int id = text_.tag("a number");
      const std::string_view name = trimmed(text_.rest_of_line());
      if (!name.empty()) names.set(id, std::string(name));
    }
  }

  /// Skips an unknown section: its lines are those that begin with a number.
  void skip_section(const std::string& section) {
    if (section.empty() || !((section[0] >= 'a' && section[0] <= 'z')))
      text_.fail("expected a section, found " + in_quotes(section));
    ++skipped_;
    text_.skip_line();
    while (text_.number_follows()) text_.skip_line();
  }

  template <std::size_t N>
  std::array<Index, N> indices(const Entity& entity) const {
    std::array<Index, N> result{};
    for (std::size_t k = 0; k < N; ++k) result[k] = index(entity, k);
    return result;
  }
  [[nodiscard]] std::vector<Index> all_indices(const Entity& entity) const {
    std::vector<Index> result;
    for (std::size_t k = 0; k < entity.nodes.size(); ++k) result.push_back(index(entity, k));
    return result;
  }
  [[nodiscard]] Index index(const Entity& entity, std::size_t k) const {
    const std::int64_t v = entity.nodes[k];
    if (v < 1 || static_cast<std::uint64_t>(v) > mesh_.vertices.size())
      text_.fail_at(entity.position, "the point " + std::to_string(v) + " does not exist; there are " +
                                         std::to_string(mesh_.vertices.size()));
    return static_cast<Index>(v - 1);
  }

  void add_entities() {
    for (const Entity& entity : tetrahedra_) add_tetrahedron(entity, regions_.resolve(entity.id));
    for (const Entity& entity : facets_) add_facet(entity, markers_.resolve(entity.id));
    for (const Entity& entity : segments_) mesh_.add_segment(indices<2>(entity), curves_.resolve(entity.id));
    mesh_.names = {markers_.take(), regions_.take(), curves_.take(), {}};
  }

  void add_tetrahedron(const Entity& entity, int id) {
    if (entity.nodes.size() == 4) {
      const auto n = indices<4>(entity);
      return mesh_.add_tetrahedron({n[0], n[2], n[1], n[3]}, id);
    }
    if (const std::size_t corners = corners_of_cell(entity.nodes.size()); corners != 0)
      return add_cell(mesh_, all_indices(entity), corners, id);
    if (entity.nodes.size() != 10)
      text_.fail_at(entity.position,
                    "elements of " + std::to_string(entity.nodes.size()) + " nodes are not read");
    const auto n = indices<10>(entity);
    add_second_order(mesh_, Tetrahedron{n[0], n[2], n[1], n[3]}, {n[5], n[7], n[4], n[6], n[9], n[8]}, id);
  }

  void add_facet(const Entity& entity, int id) {
    if (entity.nodes.size() == 3) return mesh_.add_facet(indices<3>(entity), id);
    if (entity.nodes.size() == 4)
      return add_polygon(mesh_, indices<4>(entity), id,
                         [&](const std::string& reason) { text_.fail_at(entity.position, reason); });
    if (entity.nodes.size() != 6)
      text_.fail_at(entity.position, "surface elements of " + std::to_string(entity.nodes.size()) +
                                         " nodes are not read; only triangles and quadrangles are");
    const auto n = indices<6>(entity);
    add_second_order(mesh_, Triangle{n[0], n[1], n[2]}, {n[5], n[3], n[4]}, id);
  }

  TextReader text_;
  MeshData mesh_;
  std::vector<Entity> facets_, tetrahedra_, segments_;
  std::size_t skipped_ = 0;
  NamedIds regions_{kRegionStem}, markers_{kFacetStem}, curves_{kSegmentStem};
};

void write_nodes(AtomicWriter& out, const Nodes& nodes) {
  for (const Index v : nodes) out << ' ' << std::uint64_t{v} + 1;
  out << '\n';
}

/// The nodes of a tetrahedron in Netgen's order: corners 0 2 1 3, then edges 01 02 03 12 13 23.
Nodes netgen_tetrahedron(const Nodes& nodes) {
  const auto& n = nodes.of;
  return {{n[0], n[2], n[1], n[3], n[6], n[4], n[7], n[5], n[9], n[8]}, nodes.count};
}

/// The nodes on edges opposite each corner.
Nodes netgen_triangle(const Nodes& nodes) {
  const auto& n = nodes.of;
  return {{n[0], n[1], n[2], n[4], n[5], n[3]}, nodes.count};
}

void write_names(AtomicWriter& out, std::string_view section, const Labels& labels) {
  if (labels.names.empty()) return;
  out << '\n' << section << '\n' << std::uint64_t{labels.names.size()} << '\n';
  for (const auto& [id, name] : labels.names) out << id << ' ' << name << '\n';
}

}  // namespace

MeshData read_vol(const Source& source) { return VolReader(source).read(); }

void write_vol(AtomicWriter& out, const Volume& volume) {
  const SolverLabels labels(volume, kVolNames, kVolIds);
  const std::vector<SidesOfFacet> sides = sides_of_facets(volume);
  const auto domain = [&](const std::optional<SideOfTet>& side) {
    return side ? labels.regions.ids[side->tetrahedron] : 0;
  };
  out << "mesh3d\ndimension\n3\ngeomtype\n0\n\n# surfnr bcnr domin domout np p1 p2 p3\nsurfaceelements\n"
      << std::uint64_t{volume.facets.size()} << '\n';
  for (std::size_t i = 0; i < volume.facets.size(); ++i) {
    beat(out.watch());
    const Nodes nodes = netgen_triangle(facet_nodes(volume, i));
    out << labels.facets.ids[i] << ' ' << labels.facets.ids[i] << ' ' << domain(sides[i].behind) << ' '
        << domain(sides[i].front) << ' ' << std::uint64_t{nodes.count};
    write_nodes(out, nodes);
  }
  out << "\n# matnr np p1 p2 p3 p4\nvolumeelements\n" << std::uint64_t{volume.tetrahedra.size()} << '\n';
  for (std::size_t i = 0; i < volume.tetrahedra.size(); ++i) {
    beat(out.watch());
    const Nodes nodes = netgen_tetrahedron(tetrahedron_nodes(volume, i, kVtkEdges));
    out << labels.regions.ids[i] << ' ' << std::uint64_t{nodes.count};
    write_nodes(out, nodes);
  }
  out << "\n# surfid 0 p1 p2 trignum1 trignum2 domin/surfnr1 domout/surfnr2 ednr1 dist1 ednr2 dist2\n"
      << "edgesegmentsgi2\n"
      << std::uint64_t{volume.segments.size()} << '\n';
  for (std::size_t i = 0; i < volume.segments.size(); ++i) {
    const int id = labels.segments.ids[i];
    const Segment& s = volume.segments[i];
    out << id << " 0 " << std::uint64_t{s[0]} + 1 << ' ' << std::uint64_t{s[1]} + 1 << " -1 -1 0 0 " << id
        << " 0 " << id << " 0\n";
  }
  out << "\npoints\n" << std::uint64_t{node_count(volume)} << '\n';
  for (std::size_t i = 0; i < node_count(volume); ++i) {
    const Point& p = node(volume, i);
    out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  }
  write_names(out, "materials", labels.regions);
  write_names(out, "bcnames", labels.facets);
  write_names(out, "cd2names", labels.segments);
  out << "\nendmesh\n";
}

std::vector<Remark> not_in_vol(const Volume& volume, const WriteOptions&) {
  std::vector<Remark> remarks;
  const SolverLabels labels(volume, kVolNames, kVolIds);
  for (const Labels* of : {&labels.regions, &labels.facets, &labels.segments}) tell(*of, ".vol", remarks);
  tell_left_out(volume, ".vol", true, true, remarks);
  return remarks;
}

}  // namespace holdfast::io
