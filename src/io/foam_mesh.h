// A volume in OpenFOAM's layout: faces with their owners, patches and zones.
//
// Inner faces come first, ordered by owner and then by neighbour, which has the larger number
// (upper-triangular order); then the faces of each patch. A face's normal points out of its owner.
#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "holdfast/partition.h"
#include "io/foam_file.h"
#include "io/labels.h"

namespace holdfast::io {

/// Words in OpenFOAM contain no blanks, quotes, brackets, slashes or semicolons; some other characters are
/// wildcards.
inline constexpr NameRule kFoamNames{128, "_-."};
inline constexpr IdRule kFoamIds{false};

/// A face of the mesh: its owner, its other cell, and the facet on it.
struct FoamFace {
  Triangle corners;  ///< oriented outwards from the owner
  Index owner = no_entity, neighbour = no_entity;
  Index facet = no_entity;
};

struct FoamMesh {
  std::vector<FoamFace> inside, boundary;  ///< `boundary` is sorted by patch
  struct Patch {
    std::string name;
    std::size_t first, count;
    Index other = no_entity;  ///< the process on the other side, if any
  };
  std::vector<Patch> patches;
  Labels regions, facets;
  std::map<int, std::vector<std::size_t>> zones;  ///< faces with tetrahedra on both sides, by marker
};

[[nodiscard]] FoamMesh foam_mesh(const Volume& volume, Watch& watch);

/// What all processes of a case must agree on: names of zones and patches.
struct FoamNames {
  Labels regions, facets;  ///< of the whole; no ids of entities
  std::set<int> patches, zones;
  bool has_rest = false;  ///< faces on the boundary without a marker
};

/// Adds the names of one process.
class FoamNamesOfPieces {
 public:
  void add(const Volume& own, const MeshPiece& piece, Watch& watch);
  [[nodiscard]] FoamNames take();

 private:
  std::set<int> regions_, facets_, patches_, zones_;
  bool has_rest_ = false;
  Names names_;
};

/// The tetrahedra that a piece owns, as a volume.
[[nodiscard]] Volume own_volume(const MeshPiece& piece);

/// The mesh of process `number`. The patches of its interfaces, one each, follow all other patches.
[[nodiscard]] FoamMesh foam_mesh(const Volume& own, const MeshPiece& piece, const FoamNames& names,
                                 Watch& watch);

/// The files of a polyMesh, with their folder.
[[nodiscard]] std::vector<std::filesystem::path> files_of_poly_mesh(const std::filesystem::path& folder);

/// Complete files of polyMeshes that do not have their names yet.
class FoamFiles {
 public:
  /// Writes a polyMesh into a folder, which is created if necessary; `process` is the number of the process
  /// that the mesh belongs to, if any.
  void add(const std::filesystem::path& folder, const FoamMesh& mesh, const Volume& volume, bool gzip,
           Watch& watch, Index process = no_entity);
  /// Gives all files their names.
  void commit();

 private:
  std::deque<FoamFile> files_;
  std::vector<std::filesystem::path> outdated_;  ///< what OpenFOAM might read instead
};

}  // namespace holdfast::io
