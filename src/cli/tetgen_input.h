// What `holdfast tetgen` reads, and what it makes of it besides a mesh.
#pragma once

#include <filesystem>
#include <vector>

#include "holdfast/holdfast.h"
#include "holdfast/io.h"
#include "tetgen_switches.h"

namespace holdfast::cli {

struct TetgenInput {
  std::filesystem::path path;    ///< of the surface or the points
  std::filesystem::path output;  ///< the name of the files written, without their endings
  bool is_complex = false;       ///< a surface, not points alone
  bool is_own_format = false;    ///< .poly, .smesh or .mesh: no .smesh is written beside
  int first = 0;                 ///< the number of the first vertex
  Surface surface;

  /// Every file that is read.
  [[nodiscard]] std::vector<std::filesystem::path> files(const TetgenSwitches& switches) const;
  /// Of switch i: NAME.a.node.
  [[nodiscard]] std::filesystem::path more_points() const { return beside(".a.node"); }
  /// Of switch m: NAME.b.mtr with a background mesh, if that is there, or else NAME.mtr.
  [[nodiscard]] std::filesystem::path sizes() const;

 private:
  [[nodiscard]] std::filesystem::path beside(const char* ending) const;
};

/// Finds the file, whose ending may be left out, and names the output: NAME.1, or NAME.2 for NAME.1.poly;
/// with switch I the file's own name. Throws UsageError.
[[nodiscard]] TetgenInput find_input(const std::filesystem::path& file, const TetgenSwitches& switches);

/// Reads it, with the points of switch i. Remarks go to stderr. Throws FileError.
void read_input(TetgenInput& input, const TetgenSwitches& switches, const ReadOptions& options);

/// Reads the sizes of switch m. Throws FileError.
void read_sizes(const TetgenInput& input, const ReadOptions& options, Sizes& sizes);

/// The seeds with the bounds on volumes that a file has (`RegionSeed::size` is made of them), or without.
[[nodiscard]] std::vector<RegionSeed> bounds_of_regions(std::vector<RegionSeed> seeds, bool bounded);

/// Delaunay tetrahedra of the vertices, with the hull as facets.
[[nodiscard]] Volume delaunay_volume(const Surface& points, const Limits& limits);

/// The facets of a surface that defects name, and all its vertices.
[[nodiscard]] Volume facets_of_defects(const Surface& surface, const std::vector<Defect>& defects);

/// The volume with all vertices of the surface at their own indices, used or not, then the added ones.
[[nodiscard]] Volume with_unused(const Surface& surface, Volume volume);

}  // namespace holdfast::cli
