// Writes OpenFOAM's polyMesh (OpenFOAM user guide, "Mesh description"): patches by marker on the boundary,
// cell zones by region, face zones by marker inside. Each process of a parallel run has its own mesh, with a
// patch for each other process on which its faces border.
#include <system_error>

#include "io/foam_file.h"
#include "io/foam_mesh.h"
#include "io/formats.h"

namespace holdfast::io {
namespace {

constexpr std::string_view kFiles[] = {"points",   "faces",     "owner",    "neighbour",
                                       "boundary", "cellZones", "faceZones"};

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
    for (const FoamFace& face : *part) {
      watch.beat();
      faces << "3(" << face.corners[0] << " " << face.corners[1] << " " << face.corners[2] << ")\n";
      owner << face.owner << "\n";
      if (face.neighbour != no_entity) neighbour << face.neighbour << "\n";
    }
  for (FoamFile* file : {&faces, &owner, &neighbour}) *file << ")\n";
}

void write_patches(FoamFile& file, const FoamMesh& mesh, Index process) {
  file << mesh.patches.size() << "\n(\n";
  for (const FoamMesh::Patch& patch : mesh.patches) {
    const bool between = patch.other != no_entity;
    if (between)
      file << "    procBoundary" << process << "to" << patch.other
           << "\n    {\n        type            processor;\n        inGroups        1(processor);\n";
    else
      file << "    " << patch.name << "\n    {\n        type            patch;\n";
    file << "        nFaces          " << patch.count << ";\n        startFace       "
         << mesh.inside.size() + patch.first << ";\n";
    if (between)
      file << "        matchTolerance  0.0001;\n        transform       unknown;\n        myProcNo        "
           << process << ";\n        neighbProcNo    " << patch.other << ";\n";
    file << "    }\n";
  }
  file << ")\n";
}

void write_cell_zones(FoamFile& file, const FoamMesh& mesh) {
  auto sets = mesh.regions.sets();
  file << mesh.regions.names.size() << "\n(\n";
  for (const auto& [id, name] : mesh.regions.names) {
    const std::vector<std::size_t>& cells = sets[id];
    file << name << "\n{\n    type cellZone;\n    cellLabels      List<label>\n";
    write_list(file, cells);
    file << ";\n}\n";
  }
  file << ")\n";
}

/// Whether a face is oriented against its facet.
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
    for (const std::size_t i : faces) {
      const FoamFace& face = i < mesh.inside.size() ? mesh.inside[i] : mesh.boundary[i - mesh.inside.size()];
      file << (is_flipped(face.corners, volume.facets[face.facet]) ? "1\n" : "0\n");
    }
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

std::vector<std::filesystem::path> files_of_poly_mesh(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const std::string_view name : kFiles) files.push_back(folder / name);
  return files;
}

std::vector<std::filesystem::path> openfoam_files(const std::filesystem::path& path) {
  return files_of_poly_mesh(poly_mesh_of(path));
}

void FoamFiles::add(const std::filesystem::path& folder, const FoamMesh& mesh, const Volume& volume,
                    bool gzip, Watch& watch, Index process) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw FileError(folder, "", "the folder cannot be made (" + error.message() + ")");
  const std::string note = "nPoints: " + std::to_string(volume.vertices.size()) +
                           " nCells: " + std::to_string(volume.tetrahedra.size()) +
                           " nFaces: " + std::to_string(mesh.inside.size() + mesh.boundary.size()) +
                           " nInternalFaces: " + std::to_string(mesh.inside.size());
  const auto open = [&](std::string_view object, std::string_view type, const std::string& of = {},
                        const Labels* labels = nullptr) -> FoamFile& {
    return files_.emplace_back(folder, object, type, gzip, watch, of, labels);
  };
  const std::size_t first = files_.size();
  FoamFile& points = open("points", "vectorField");
  FoamFile& faces = open("faces", "faceList");
  FoamFile& owner = open("owner", "labelList", note);
  FoamFile& neighbour = open("neighbour", "labelList", note);
  FoamFile& boundary = open("boundary", "polyBoundaryMesh", {}, &mesh.facets);
  FoamFile& cell_zones = open("cellZones", "regIOobject", {}, &mesh.regions);
  FoamFile& face_zones = open("faceZones", "regIOobject", {}, &mesh.facets);
  write_faces(points, faces, owner, neighbour, mesh, volume, watch);
  write_patches(boundary, mesh, process);
  write_cell_zones(cell_zones, mesh);
  write_face_zones(face_zones, mesh, volume);
  for (std::size_t i = first; i < files_.size(); ++i) files_[i].finish();
  for (const std::filesystem::path& name : files_of_poly_mesh(folder)) {
    outdated_.push_back(name);
    if (!gzip) outdated_.back() += ".gz";
  }
}

// OpenFOAM reads the uncompressed file if both exist.
void FoamFiles::commit() {
  for (FoamFile& file : files_) file.commit();
  std::error_code error;
  for (const std::filesystem::path& name : outdated_) std::filesystem::remove(name, error);
}

void write_openfoam(const std::filesystem::path& path, const Volume& volume, const WriteOptions& options,
                    Watch& watch) {
  if (volume.tetrahedra.empty())
    throw FileError(poly_mesh_of(path), "",
                    "a surface without tetrahedra has no place in OpenFOAM; its STL files take it");
  FoamFiles files;
  files.add(poly_mesh_of(path), foam_mesh(volume, watch), volume, options.gzip, watch);
  files.commit();
}

std::vector<Remark> not_in_openfoam(const Volume& volume, const WriteOptions&) {
  std::vector<Remark> remarks;
  tell(labels_of(kRegionStem, volume.regions, volume.tetrahedra.size(), volume.names.regions, kFoamNames,
                 kFoamIds),
       "OpenFOAM", remarks);
  tell(labels_of(kFacetStem, volume.facet_markers, volume.facets.size(), volume.names.facets, kFoamNames,
                 kFoamIds),
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
