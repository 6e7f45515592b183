// The input of `mesh`: surfaces read from files, parts from several files, and the messages about them.
#pragma once

#include <optional>
#include <vector>

#include "holdfast/holdfast.h"
#include "holdfast/paste.h"
#include "mesh_options.h"
#include "progress.h"

namespace holdfast::cli {

/// The input to mesh: one surface, or the parts of several files.
struct MeshInput {
  Surface surface;
  std::vector<Surface> parts;  ///< empty where the surface is meshed as it is
  std::optional<PasteResult> pasted;
};

/// Reads the files. Throws FileError.
[[nodiscard]] MeshInput read_input(const MeshArguments& arguments, const Options& options);

/// Several files are parts where they have triangles in common, or where that was asked for; then components
/// of a single file are, too.
void paste_parts(const MeshArguments& arguments, const Options& options, MeshInput& input);

/// Facets that files have in common are no defect; what is one is told by the indices of the files in turn.
void tell_defects_of_files(const MeshArguments& arguments, const MeshInput& input, Result& result);

/// Gives the facets without a marker one for each smooth patch, and says how many there are. Throws
/// UsageError if all have one.
void split_by_angle(const MeshArguments& arguments, Surface& surface);

/// Says which vertices are on no facet and no segment: they become vertices of the mesh, which is seldom
/// meant for those inside a volume that is meshed again.
void tell_of_lone_vertices(const MeshArguments& arguments, const Surface& surface, ProgressView& progress);

/// Says that sizes of regions in the file are unused: they are for field points.
void tell_unused_sizes(const MeshArguments& arguments, const Surface& surface);

/// Says that a background mesh has sizes nowhere near the surface, as one in another unit may.
void tell_field_elsewhere(const MeshArguments& arguments, const Extent& field, const Surface& surface);

/// Sizes in a file without a background mesh are those of the surface's vertices. Throws FileError if they
/// are not as many.
void require_a_size_a_vertex(const MeshArguments& arguments, const Options& options, const Surface& surface);

}  // namespace holdfast::cli
