// Writes OpenFOAM's polyMesh (OpenFOAM user guide, "Mesh description"): patches by marker on the boundary,
// cell zones by region, face zones by marker inside.
//
// Faces inside come first, by the cell that they belong to and then by their neighbour, which has the larger
// number (upper-triangular order); then those of each patch. A face's normal leads out of its owner.
#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <set>
#include <stdexcept>
#include <system_error>

#include "io/formats.h"
#include "io/labels.h"
#include "io/mesh_sets.h"
#include "numbers/sorted.h"

namespace holdfast::io {
namespace {

/// OpenFOAM's words have neither blanks nor quotes, brackets, slashes or semicolons; others are wildcards.
constexpr NameRule kNames{128, "_-."};
constexpr IdRule kAnyId{false};
constexpr std::string_view kFiles[] = {"points",   "faces",     "owner",    "neighbour",
                                       "boundary", "cellZones", "faceZones"};

/// Text of a file that may be packed by gzip on its way.
class FoamFile {
 public:
  FoamFile(const std::filesystem::path& folder, std::string_view object, std::string_view type, bool gzip,
           Watch& watch, const std::string& note = {}, const Labels* labels = nullptr)
      : out_(folder / (std::string(object) + (gzip ? ".gz" : "")), &watch), gzip_(gzip) {
    constexpr int kWindowOfGzip = 15 + 16;
    if (gzip_ && deflateInit2(&stream_, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kWindowOfGzip, 8,
                              Z_DEFAULT_STRATEGY) != Z_OK)
      throw std::bad_alloc();
    if (labels != nullptr)  // what a reader finds the ids of names by
      for (const auto& [id, name] : labels->names)
        *this << "// " << labels->stem << " " << id << " " << name << "\n";
    *this << "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       " << type << ";\n";
    if (!note.empty()) *this << "    note        \"" << note << "\";\n";
    *this << "    location    \"constant/polyMesh\";\n    object      " << object << ";\n}\n\n";
  }
  ~FoamFile() {
    if (gzip_) deflateEnd(&stream_);
  }
  FoamFile(FoamFile&&) = delete;

  FoamFile& operator<<(std::string_view text) {
    if (!gzip_) return out_ << text, *this;
    pending_ += text;
    if (pending_.size() > kBlock) deflate_pending(Z_NO_FLUSH);
    return *this;
  }
  template <typename Number>
  requires std::is_arithmetic_v<Number> FoamFile& operator<<(Number value) {
    char digits[40];
    std::to_chars_result result{};
    result = std::to_chars(digits, digits + sizeof digits, value);
    return *this << std::string_view(digits, static_cast<std::size_t>(result.ptr - digits));
  }

  void finish() {
    if (gzip_) deflate_pending(Z_FINISH);
    out_.finish();
  }
  void commit() { out_.commit(); }

 private:
  static constexpr std::size_t kBlock = std::size_t{1} << 16;

  void deflate_pending(int flush) {
    stream_.next_in = reinterpret_cast<Bytef*>(pending_.data());
    stream_.avail_in = static_cast<uInt>(pending_.size());
    do {
      stream_.next_out = reinterpret_cast<Bytef*>(room_.get());
      stream_.avail_out = static_cast<uInt>(kBlock);
      deflate(&stream_, flush);
      out_ << std::string_view(room_.get(), kBlock - stream_.avail_out);
    } while (stream_.avail_out == 0);
    pending_.clear();
  }

  AtomicWriter out_;
  bool gzip_;
  z_stream stream_{};
  std::string pending_;
  std::unique_ptr<char[]> room_ = std::make_unique<char[]>(kBlock);
};

/// A face of the mesh: its owner, its other cell, and the facet that lies on it.
struct Face {
  Triangle corners;  ///< seen from outside the owner
  Index owner = no_entity, neighbour = no_entity;
  Index facet = no_entity;
};

struct Side {
  Triangle key;
  Index cell;
  std::uint8_t side;
};

struct FoamMesh {
  std::vector<Face> inside, boundary;  ///< the second by patch
  struct Patch {
    std::string name;
    std::size_t first, count;
  };
  std::vector<Patch> patches;
  Labels regions, facets;
  std::map<int, std::vector<std::size_t>> zones;  ///< faces inside by marker
};

std::vector<Side> sorted_sides(const Volume& volume, Watch& watch) {
  std::vector<Side> sides;
  sides.reserve(4 * volume.tetrahedra.size());
  for (Index t = 0; t < volume.tetrahedra.size(); ++t)
    for (std::uint8_t i = 0; i < 4; ++i) {
      watch.beat();
      const Tetrahedron& c = volume.tetrahedra[t];
      const auto& f = kOutwardFaces[i];
      sides.push_back({ascending(Triangle{c[f[0]], c[f[1]], c[f[2]]}), t, i});
    }
  std::sort(sides.begin(), sides.end(), [&](const Side& a, const Side& b) {
    watch.beat();
    return a.key != b.key ? a.key < b.key : a.cell < b.cell;
  });
  return sides;
}

/// Faces inside and on the boundary, with their facets.
void find_faces(const Volume& volume, FoamMesh& mesh, Watch& watch) {
  std::map<Triangle, Index> facet_at;
  for (Index f = 0; f < volume.facets.size(); ++f) facet_at.emplace(ascending(volume.facets[f]), f);
  const std::vector<Side> sides = sorted_sides(volume, watch);
  for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
    watch.beat();
    for (j = i; j < sides.size() && sides[j].key == sides[i].key;) ++j;
    if (j > i + 2)
      throw std::invalid_argument("a face of more than two tetrahedra, which OpenFOAM has no place for");
    const Tetrahedron& c = volume.tetrahedra[sides[i].cell];
    const auto& f = kOutwardFaces[sides[i].side];
    Face face{{c[f[0]], c[f[1]], c[f[2]]}, sides[i].cell, no_entity, no_entity};
    if (j == i + 2) face.neighbour = sides[i + 1].cell;
    if (const auto found = facet_at.find(sides[i].key); found != facet_at.end()) face.facet = found->second;
    (j == i + 2 ? mesh.inside : mesh.boundary).push_back(face);
  }
  std::sort(mesh.inside.begin(), mesh.inside.end(), [&](const Face& a, const Face& b) {
    watch.beat();
    return a.owner != b.owner ? a.owner < b.owner : a.neighbour < b.neighbour;
  });
}

void make_patches(FoamMesh& mesh) {
  const auto has_facet = [](const Face& face) { return face.facet != no_entity; };
  const auto id_of = [&](const Face& face) { return mesh.facets.ids[face.facet]; };
  std::sort(mesh.boundary.begin(), mesh.boundary.end(), [&](const Face& a, const Face& b) {
    if (has_facet(a) != has_facet(b)) return has_facet(a);
    if (has_facet(a) && id_of(a) != id_of(b)) return id_of(a) < id_of(b);
    return a.owner != b.owner ? a.owner < b.owner : a.corners < b.corners;
  });
  std::set<std::string> taken;
  for (const auto& [id, name] : mesh.facets.names) taken.insert(name);
  std::string rest = "defaultFaces";  // OpenFOAM's own name for faces of no patch
  while (taken.contains(rest)) rest += '_';
  for (std::size_t i = 0, j = 0; i < mesh.boundary.size(); i = j) {
    const bool named = has_facet(mesh.boundary[i]);
    for (j = i; j < mesh.boundary.size() && has_facet(mesh.boundary[j]) == named &&
                (!named || id_of(mesh.boundary[j]) == id_of(mesh.boundary[i]));)
      ++j;
    mesh.patches.push_back({named ? mesh.facets.names.at(id_of(mesh.boundary[i])) : rest, i, j - i});
  }
}

FoamMesh foam_mesh(const Volume& volume, Watch& watch) {
  FoamMesh mesh;
  mesh.regions =
      labels_of(kRegionStem, volume.regions, volume.tetrahedra.size(), volume.names.regions, kNames, kAnyId);
  mesh.facets =
      labels_of(kFacetStem, volume.facet_markers, volume.facets.size(), volume.names.facets, kNames, kAnyId);
  find_faces(volume, mesh, watch);
  make_patches(mesh);
  for (std::size_t i = 0; i < mesh.inside.size(); ++i)
    if (mesh.inside[i].facet != no_entity) mesh.zones[mesh.facets.ids[mesh.inside[i].facet]].push_back(i);
  return mesh;
}

template <typename Values>
void write_list(FoamFile& file, const Values& values) {
  file << values.size() << "\n(\n";
  for (const auto& value : values) file << value << "\n";
  file << ")\n";
}

void write_faces(FoamFile& points, FoamFile& faces, FoamFile& owner, FoamFile& neighbour,
                 const FoamMesh& mesh, const Volume& volume, Watch& watch) {
  points << volume.vertices.size() << "\n(\n";
  for (const Point& p : volume.vertices) {
    watch.beat();
    points << "(" << p[0] << " " << p[1] << " " << p[2] << ")\n";
  }
  points << ")\n";
  const std::size_t count = mesh.inside.size() + mesh.boundary.size();
  faces << count << "\n(\n";
  owner << count << "\n(\n";
  neighbour << mesh.inside.size() << "\n(\n";
  for (const auto* part : {&mesh.inside, &mesh.boundary})
    for (const Face& face : *part) {
      watch.beat();
      faces << "3(" << face.corners[0] << " " << face.corners[1] << " " << face.corners[2] << ")\n";
      owner << face.owner << "\n";
      if (face.neighbour != no_entity) neighbour << face.neighbour << "\n";
    }
  for (FoamFile* file : {&faces, &owner, &neighbour}) *file << ")\n";
}

void write_patches(FoamFile& file, const FoamMesh& mesh) {
  file << mesh.patches.size() << "\n(\n";
  for (const FoamMesh::Patch& patch : mesh.patches)
    file << "    " << patch.name << "\n    {\n        type            patch;\n        nFaces          "
         << patch.count << ";\n        startFace       " << mesh.inside.size() + patch.first << ";\n    }\n";
  file << ")\n";
}

void write_cell_zones(FoamFile& file, const FoamMesh& mesh) {
  const auto sets = mesh.regions.sets();
  file << sets.size() << "\n(\n";
  for (const auto& [id, cells] : sets) {
    file << mesh.regions.names.at(id) << "\n{\n    type cellZone;\n    cellLabels      List<label>\n";
    write_list(file, cells);
    file << ";\n}\n";
  }
  file << ")\n";
}

/// Whether a face looks the other way than its facet.
bool is_flipped(const Triangle& face, const Triangle& facet) {
  for (std::size_t k = 0; k < 3; ++k)
    if (face[0] == facet[k]) return face[1] != facet[(k + 1) % 3];
  return false;
}

void write_face_zones(FoamFile& file, const FoamMesh& mesh, const Volume& volume) {
  file << mesh.zones.size() << "\n(\n";
  for (const auto& [id, faces] : mesh.zones) {
    file << mesh.facets.names.at(id) << "\n{\n    type faceZone;\n    faceLabels      List<label>\n";
    write_list(file, faces);
    file << ";\n    flipMap         List<bool>\n" << faces.size() << "\n(\n";
    for (const std::size_t i : faces)
      file << (is_flipped(mesh.inside[i].corners, volume.facets[mesh.inside[i].facet]) ? "1\n" : "0\n");
    file << ")\n;\n}\n";
  }
  file << ")\n";
}

}  // namespace

bool is_poly_mesh(const std::filesystem::path& path) {
  if ((path.has_filename() ? path : path.parent_path()).filename() == "polyMesh") return true;
  std::error_code error;
  return !path.empty() && std::filesystem::is_directory(path / "constant" / "polyMesh", error);
}

std::filesystem::path poly_mesh_of(const std::filesystem::path& path) {
  const std::filesystem::path named = path.has_filename() ? path : path.parent_path();
  return named.filename() == "polyMesh" ? named : named / "constant" / "polyMesh";
}

std::vector<std::filesystem::path> openfoam_files(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files;
  for (const std::string_view name : kFiles) files.push_back(poly_mesh_of(path) / name);
  return files;
}

void write_openfoam(const std::filesystem::path& path, const Volume& volume, const WriteOptions& options,
                    Watch& watch) {
  const std::filesystem::path folder = poly_mesh_of(path);
  if (volume.tetrahedra.empty())
    throw FileError(folder, "",
                    "a surface without tetrahedra has no place in OpenFOAM; its STL files take it");
  const FoamMesh mesh = foam_mesh(volume, watch);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw FileError(folder, "", "the folder cannot be made (" + error.message() + ")");
  const std::string note = "nPoints: " + std::to_string(volume.vertices.size()) +
                           " nCells: " + std::to_string(volume.tetrahedra.size()) +
                           " nFaces: " + std::to_string(mesh.inside.size() + mesh.boundary.size()) +
                           " nInternalFaces: " + std::to_string(mesh.inside.size());
  const bool gzip = options.gzip;
  FoamFile points(folder, "points", "vectorField", gzip, watch);
  FoamFile faces(folder, "faces", "faceList", gzip, watch);
  FoamFile owner(folder, "owner", "labelList", gzip, watch, note);
  FoamFile neighbour(folder, "neighbour", "labelList", gzip, watch, note);
  FoamFile boundary(folder, "boundary", "polyBoundaryMesh", gzip, watch, {}, &mesh.facets);
  FoamFile cell_zones(folder, "cellZones", "regIOobject", gzip, watch, {}, &mesh.regions);
  FoamFile face_zones(folder, "faceZones", "regIOobject", gzip, watch, {}, &mesh.facets);
  write_faces(points, faces, owner, neighbour, mesh, volume, watch);
  write_patches(boundary, mesh);
  write_cell_zones(cell_zones, mesh);
  write_face_zones(face_zones, mesh, volume);
  FoamFile* const all[] = {&points, &faces, &owner, &neighbour, &boundary, &cell_zones, &face_zones};
  // All are complete before any gets its name.
  for (FoamFile* file : all) file->finish();
  for (FoamFile* file : all) file->commit();
  // OpenFOAM takes the plain file where both are there.
  for (const std::filesystem::path& name : openfoam_files(path)) {
    std::filesystem::path other = name;
    if (!gzip) other += ".gz";
    std::filesystem::remove(other, error);
  }
}

std::vector<Remark> not_in_openfoam(const Volume& volume, const WriteOptions&) {
  std::vector<Remark> remarks;
  tell(labels_of(kRegionStem, volume.regions, volume.tetrahedra.size(), volume.names.regions, kNames, kAnyId),
       "OpenFOAM", remarks);
  tell(labels_of(kFacetStem, volume.facet_markers, volume.facets.size(), volume.names.facets, kNames, kAnyId),
       "OpenFOAM", remarks);
  const auto say = [&](std::size_t count, const std::string& what) {
    if (count > 0)
      remarks.push_back(
          {RemarkKind::not_held, count, std::to_string(count) + " " + what + " have no place in OpenFOAM"});
  };
  say(volume.segments.size(), "segments");
  say(volume.mid_nodes.points.size(), "nodes in the middle of edges");
  tell_marked_vertices(volume, "OpenFOAM", remarks);
  return remarks;
}

}  // namespace holdfast::io
