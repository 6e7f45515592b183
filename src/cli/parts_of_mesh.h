// Parts of a mesh: only its volume, its surface, some of its regions; and the same mesh in another unit.
#pragma once

#include <string>
#include <vector>

#include "any_mesh.h"

namespace holdfast::cli {

/// The part requested by --only.
struct Part {
  enum class Kind { all, volume, surface, regions };
  Kind kind = Kind::all;
  std::vector<std::string> regions;  ///< ids or names
};

/// Parses "volume", "surface", or any number of "region=ID" and "region=NAME". Throws UsageError.
[[nodiscard]] Part part_of(const std::vector<std::string>& only);

/// The ids that a text names: a number, with or without a preceding "region:", or the name of regions; none
/// if there is no such name.
[[nodiscard]] std::vector<int> region_ids(std::string text, const Names& names);

/// Keeps only the part of a mesh and the vertices that it uses. The facets of regions are those on their
/// boundary or inside. Throws UsageError for parts that the mesh does not have.
void take_part(AnyMesh& mesh, const Part& part);

/// Drops the facets with tetrahedra on both sides.
void drop_interfaces(Volume& volume);

/// Multiplies all lengths. Returns how many tetrahedra become inverted or flat by rounding. Throws UsageError
/// if a coordinate becomes too large.
[[nodiscard]] std::size_t scale(AnyMesh& mesh, double factor);

}  // namespace holdfast::cli
