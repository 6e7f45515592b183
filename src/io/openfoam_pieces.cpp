// Writes pieces as OpenFOAM's processes read them: a case with processork/constant/polyMesh.
//
// All processes have the same patches and zones in the same order, even if empty. Patches to other processes
// come last; their faces have the same order on both sides and start at the same vertex, with opposite
// orientations.
#include <system_error>
#include <vector>

#include "io/foam_mesh.h"
#include "io/formats.h"
#include "io/pieces.h"

namespace holdfast::io {
namespace {

/// The path without constant/polyMesh.
std::filesystem::path case_of(const std::filesystem::path& path) {
  const std::filesystem::path constant = poly_mesh_of(path).parent_path();
  return constant.filename() == "constant" ? constant.parent_path() : constant;
}

/// OpenFOAM counts the folders of processes, so those left from a run with more must not exist.
void require_no_more(const std::filesystem::path& path, std::size_t parts) {
  const std::filesystem::path next = case_of(path) / ("processor" + std::to_string(parts));
  std::error_code error;
  if (std::filesystem::exists(next, error))
    throw FileError(next, "",
                    "is of a run with more processes than " + std::to_string(parts) +
                        ", and OpenFOAM counts these folders; remove it and those after it");
}

/// Folders of processes that do not exist yet. Those that are still empty in the end are removed: OpenFOAM
/// counts them.
class NewFolders {
 public:
  NewFolders() = default;
  NewFolders(NewFolders&&) = delete;
  ~NewFolders() {
    std::error_code error;
    for (const std::filesystem::path& mesh : meshes_)
      for (const auto& folder : {mesh, mesh.parent_path(), mesh.parent_path().parent_path()})
        std::filesystem::remove(folder, error);
  }
  void add(const std::filesystem::path& mesh) {
    std::error_code error;
    if (!std::filesystem::exists(mesh.parent_path().parent_path(), error)) meshes_.push_back(mesh);
  }

 private:
  std::vector<std::filesystem::path> meshes_;
};

}  // namespace

std::filesystem::path processor_mesh(const std::filesystem::path& path, std::size_t k) {
  return case_of(path) / ("processor" + std::to_string(k)) / "constant" / "polyMesh";
}

void write_processors(const std::filesystem::path& path, std::size_t parts, const PieceLoader& load,
                      const WriteOptions& options, Watch& watch) {
  require_no_more(path, parts);
  FoamNamesOfPieces names_of_pieces;
  for (std::size_t k = 0; k < parts; ++k) {
    const MeshPiece piece = load(k);
    names_of_pieces.add(own_volume(piece), piece, watch);
  }
  const FoamNames names = names_of_pieces.take();
  NewFolders folders;
  FoamFiles files;
  for (std::size_t k = 0; k < parts; ++k) {
    const MeshPiece piece = load(k);
    const Volume own = own_volume(piece);
    const std::filesystem::path folder = processor_mesh(path, k);
    folders.add(folder);
    files.add(folder, foam_mesh(own, piece, names, watch), own, options.gzip, watch, static_cast<Index>(k));
  }
  files.commit();
}

}  // namespace holdfast::io
