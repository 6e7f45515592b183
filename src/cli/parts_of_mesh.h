// Parts of a mesh: its volume alone, its surface, some of its regions; and the same mesh in another unit.
#pragma once

#include <string>
#include <vector>

#include "any_mesh.h"

namespace holdfast::cli {

/// What --only asks for.
struct Part {
  enum class Kind { all, volume, surface, regions };
  Kind kind = Kind::all;
  std::vector<std::string> regions;  ///< ids or names
};

/// Reads "volume", "surface", "region=ID" or "region=NAME", this several times. Throws UsageError.
[[nodiscard]] Part part_of(const std::vector<std::string>& only);

/// Ids that a text names: a number, with or without "region:" before it, or the name of regions; none if
/// there is no such name.
[[nodiscard]] std::vector<int> region_ids(std::string text, const Names& names);

/// Leaves the part of a mesh alone, with the vertices that it uses. The facets of regions are those on their
/// boundary or within. Throws UsageError for parts that the mesh does not have.
void take_part(AnyMesh& mesh, const Part& part);

/// Leaves out the facets with tetrahedra on both sides.
void drop_interfaces(Volume& volume);

/// Multiplies all lengths. Returns how many tetrahedra are turned or flat only now, by rounding. Throws
/// UsageError where a coordinate becomes too large.
[[nodiscard]] std::size_t scale(AnyMesh& mesh, double factor);

}  // namespace holdfast::cli
