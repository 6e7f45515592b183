// MFEM's meshes (mfem.org, "Mesh formats"): version 1.0, and 1.3 if attributes have names. The elements of a
// surface are its triangles, and those of the plane have two coordinates.
#include <algorithm>

#include "io/cells.h"
#include "io/fields.h"
#include "io/polygon.h"
#include "io/solver_text.h"
#include "io/two_dimensions.h"

namespace holdfast::io {
namespace {

constexpr NameRule kMfemNames{255, "!#$%&'()*+,-./:;<=>?@[]^_`{|}~", true, true, false, true};
constexpr IdRule kMfemIds{};
constexpr int kMfemSegment = 1, kMfemTriangle = 2, kMfemTetrahedron = 4,
              kMfemPyramid = 7;  // 3: squares, 5: cubes, 6: prisms

class MfemReader {
 public:
  explicit MfemReader(const Source& source) : text_(source) {}

  MeshData read() {
    const std::string_view first = trimmed(text_.rest_of_line());
    if (!first.starts_with("MFEM mesh v1."))
      text_.fail("not an MFEM mesh of version 1: it does not start with 'MFEM mesh v1.'");
    while (!text_.at_end()) read_section();
    add_entities();
    return std::move(mesh_);
  }

 private:
  struct Entity {
    int attribute;
    std::int64_t type;
    std::array<std::int64_t, 8> corners;
    std::size_t position;
  };

  void read_section() {
    const std::string name(text_.word("a section"));
    if (name == "dimension") {
      const std::int64_t dimension = text_.integer("the dimension");
      if (dimension != 2 && dimension != 3) text_.fail("the dimension is neither 2 nor 3");
      is_surface_ = dimension == 2;
    } else if (name == "elements" || name == "boundary") {
      read_entities();
    } else if (name == "attribute_sets") {
      read_sets(is_surface_ ? facets_ : regions_);
    } else if (name == "bdr_attribute_sets") {
      read_sets(is_surface_ ? segments_ : facets_);
    } else if (name == "vertices") {
      read_vertices();
    } else if (name == "mfem_mesh_end") {
      text_.seek(text_.source().bytes.size());
    } else {
      text_.fail("the section " + in_quotes(name) + " is not read; only straight meshes of simplices are");
    }
  }

  void read_entities() {
    const std::size_t count = text_.count("the number of elements", 8);
    for (std::size_t i = 0; i < count; ++i) {
      Entity entity{text_.tag("an attribute"), text_.integer("a geometry type"), {}, 0};
      entity.position = text_.last();
      if (entity.type < kMfemSegment || entity.type > kMfemPyramid)
        text_.fail("elements of geometry " + std::to_string(entity.type) + " are not read");
      for (std::size_t k = 0; k < corners_of(entity.type); ++k)
        entity.corners[k] = text_.integer("a vertex index");
      entities_.push_back(entity);
    }
  }

  static std::size_t corners_of(std::int64_t type) {
    constexpr std::size_t kCorners[] = {2, 3, 4, 4, 8, 6, 5};
    return kCorners[static_cast<std::size_t>(type - kMfemSegment)];
  }

  /// Reads lines with a quoted name, a number of attributes, and these. A set of one attribute names it.
  void read_sets(NamedIds& names) {
    const std::size_t count = text_.count("the number of sets", 4);
    for (std::size_t i = 0; i < count; ++i) {
      if (text_.at_end()) text_.fail_truncated("a name in quotes");
      const std::string_view rest = text_.remaining();
      const std::size_t end = rest.find('"', 1);
      if (rest[0] != '"' || end == std::string_view::npos) {
        text_.seek(text_.position());
        text_.fail("expected a name in quotes");
      }
      const std::string name(rest.substr(1, end - 1));
      text_.seek(text_.position() + end + 1);
      const std::size_t size = text_.count("the number of attributes", 2);
      for (std::size_t k = 0; k < size; ++k) {
        const int attribute = text_.tag("an attribute");
        if (size == 1) names.set(attribute, name);
      }
      if (size != 1) mesh_.leave_out(1, "sets of several attributes", "set of several attributes");
    }
  }

  void read_vertices() {
    const std::size_t count = text_.count("the number of vertices", 2);
    if (!text_.number_follows())
      text_.fail("meshes whose nodes are a function are not read; save them straight");
    const std::int64_t dimension = text_.integer("the space's dimension");
    if (dimension != 3 && !(dimension == 2 && is_surface_))
      text_.fail("the space's dimension is neither 3 nor that of the mesh");
    for (std::size_t i = 0; i < count; ++i)
      mesh_.vertices.push_back(
          dimension == 3 ? text_.point() : Point{text_.real("a coordinate"), text_.real("a coordinate"), 0});
  }

  void add_entities() {
    for (const Entity& entity : entities_) {
      std::array<Index, 8> n{};
      const std::size_t corners = corners_of(entity.type);
      for (std::size_t k = 0; k < corners; ++k) {
        if (entity.corners[k] < 0 || static_cast<std::uint64_t>(entity.corners[k]) >= mesh_.vertices.size())
          text_.fail_at(entity.position, "the vertex " + std::to_string(entity.corners[k]) +
                                             " does not exist; there are " +
                                             std::to_string(mesh_.vertices.size()));
        n[k] = static_cast<Index>(entity.corners[k]);
      }
      if (entity.type == kMfemTetrahedron)
        mesh_.add_tetrahedron({n[0], n[1], n[2], n[3]}, regions_.resolve(entity.attribute));
      else if (entity.type > kMfemTetrahedron)
        add_cell(mesh_, std::span(n).first(corners), corners, regions_.resolve(entity.attribute));
      else if (entity.type == kMfemSegment)
        mesh_.add_segment({n[0], n[1]}, segments_.resolve(entity.attribute));
      else
        add_polygon(mesh_, std::span(n).first(corners), facets_.resolve(entity.attribute),
                    [&](const std::string& reason) { text_.fail_at(entity.position, reason); });
    }
    mesh_.names.regions = regions_.take();
    mesh_.names.facets = facets_.take();
    mesh_.names.segments = segments_.take();
  }

  TextReader text_;
  MeshData mesh_;
  std::vector<Entity> entities_;
  NamedIds regions_{kRegionStem}, facets_{kFacetStem}, segments_{kSegmentStem};
  bool is_surface_ = false;
};

template <std::size_t N>
void write_entities(AtomicWriter& out, std::string_view section, int type, const Labels& labels,
                    const std::vector<std::array<Index, N>>& entities) {
  out << '\n' << section << '\n' << std::uint64_t{entities.size()} << '\n';
  for (std::size_t i = 0; i < entities.size(); ++i) {
    beat(out.watch());
    out << labels.ids[i] << ' ' << type;
    for (const Index v : entities[i]) out << ' ' << v;
    out << '\n';
  }
}

void write_sets(AtomicWriter& out, std::string_view section, const Labels& labels) {
  out << '\n' << section << '\n' << std::uint64_t{labels.names.size()} << '\n';
  for (const auto& [id, name] : labels.names) out << '"' << name << "\" 1 " << id << '\n';
}

/// The labels of the cells and of their boundary.
struct MfemLabels {
  Labels cells, boundary;
  bool has_names;

  MfemLabels(const Volume& volume, const Sides& sides) {
    SolverLabels all(volume, kMfemNames, kMfemIds);
    const bool is_surface = has_cells_of_triangles(volume);
    boundary = is_surface ? labels_of(kSegmentStem, sides.markers, sides.segments.size(),
                                      volume.names.segments, kMfemNames, kMfemIds)
                          : std::move(all.facets);
    cells = is_surface ? std::move(all.facets) : std::move(all.regions);
    const Names& names = volume.names;
    has_names = !(is_surface ? names.segments : names.regions).empty() || !names.facets.empty() ||
                !cells.renumbered.empty() || !boundary.renumbered.empty();
  }
};

Sides sides_of(const Volume& volume) {
  return has_cells_of_triangles(volume) ? Sides(volume) : Sides(Volume{});
}

}  // namespace

MeshData read_mfem(const Source& source) { return MfemReader(source).read(); }

void write_mfem(AtomicWriter& out, const Volume& volume) {
  const bool is_surface = has_cells_of_triangles(volume);
  const Sides sides = sides_of(volume);
  const MfemLabels labels(volume, sides);
  out << (labels.has_names ? "MFEM mesh v1.3\n" : "MFEM mesh v1.0\n") << "\ndimension\n"
      << (is_surface ? "2\n" : "3\n");
  if (is_surface)
    write_entities(out, "elements", kMfemTriangle, labels.cells, volume.facets);
  else
    write_entities(out, "elements", kMfemTetrahedron, labels.cells, volume.tetrahedra);
  if (labels.has_names) write_sets(out, "attribute_sets", labels.cells);
  if (is_surface)
    write_entities(out, "boundary", kMfemSegment, labels.boundary, sides.segments);
  else
    write_entities(out, "boundary", kMfemTriangle, labels.boundary, volume.facets);
  if (labels.has_names) write_sets(out, "bdr_attribute_sets", labels.boundary);
  const std::size_t dimension = is_in_plane(volume) ? 2 : 3;
  out << "\nvertices\n" << std::uint64_t{volume.vertices.size()} << '\n' << std::uint64_t{dimension} << '\n';
  for (const Point& p : volume.vertices) {
    out << p[0] << ' ' << p[1];
    if (dimension == 3) out << ' ' << p[2];
    out << '\n';
  }
  if (labels.has_names) out << "\nmfem_mesh_end\n";
}

std::vector<Remark> not_in_mfem(const Volume& volume, const WriteOptions&) {
  std::vector<Remark> remarks;
  const MfemLabels labels(volume, sides_of(volume));
  tell(labels.cells, "MFEM", remarks);
  tell(labels.boundary, "MFEM", remarks);
  tell_left_out(volume, "MFEM's meshes", has_cells_of_triangles(volume), false, remarks);
  return remarks;
}

}  // namespace holdfast::io
