// The input of `holdfast tetgen`, and its outputs other than a mesh.
#pragma once

#include <filesystem>
#include <vector>

#include "holdfast/holdfast.h"
#include "holdfast/io.h"
#include "tetgen_switches.h"

namespace holdfast::cli {

struct TetgenInput {
  std::filesystem::path path;    ///< of the surface or the points
  std::filesystem::path output;  ///< the name of the output files without extension
  bool is_complex = false;       ///< a surface, not only points
  bool is_own_format = false;    ///< .poly, .smesh or .mesh: no .smesh is written
  int first = 0;                 ///< the number of the first vertex
  Surface surface;

  /// All files to read.
  [[nodiscard]] std::vector<std::filesystem::path> files(const TetgenSwitches& switches) const;
  /// The file of switch i: NAME.a.node.
  [[nodiscard]] std::filesystem::path more_points() const { return beside(".a.node"); }
  /// The file of switch m: NAME.b.mtr with a background mesh if it exists, otherwise NAME.mtr.
  [[nodiscard]] std::filesystem::path sizes() const;

 private:
  [[nodiscard]] std::filesystem::path beside(const char* ending) const;
};

/// Finds the file, whose extension may be missing, and names the output: NAME.1, or NAME.2 for NAME.1.poly;
/// with switch I, the file's own name. Throws UsageError.
[[nodiscard]] TetgenInput find_input(const std::filesystem::path& file, const TetgenSwitches& switches);

/// Reads the file, with the points of switch i. Remarks go to stderr. Throws FileError.
void read_input(TetgenInput& input, const TetgenSwitches& switches, const ReadOptions& options);

/// Reads the sizes of switch m. Throws FileError.
void read_sizes(const TetgenInput& input, const ReadOptions& options, Sizes& sizes);

/// The seeds, with or without the bounds on volumes in the file (the source of `RegionSeed::size`).
[[nodiscard]] std::vector<RegionSeed> bounds_of_regions(std::vector<RegionSeed> seeds, bool bounded);

/// Delaunay tetrahedra of the vertices, with the hull as facets.
[[nodiscard]] Volume delaunay_volume(const Surface& points, const Limits& limits);

/// The facets of a surface that defects name, with all its vertices.
[[nodiscard]] Volume facets_of_defects(const Surface& surface, const std::vector<Defect>& defects);

/// The volume with all vertices of the surface at their own indices, used or not, followed by the added ones.
[[nodiscard]] Volume with_unused(const Surface& surface, Volume volume);

}  // namespace holdfast::cli
