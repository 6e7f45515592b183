// The input of `mesh`: surfaces read from files, parts from several files, and the messages about them.
#pragma once

#include <optional>
#include <vector>

#include "holdfast/holdfast.h"
#include "holdfast/paste.h"
#include "mesh_options.h"
#include "progress.h"

namespace holdfast::cli {

/// The input of the mesher: one surface, or the parts of several files.
struct MeshInput {
  Surface surface;
  std::vector<Surface> parts;  ///< empty if the surface is meshed as it is
  std::optional<PasteResult> pasted;
};

/// Reads the files. Throws FileError.
[[nodiscard]] MeshInput read_input(const MeshArguments& arguments, const Options& options);

/// Several files are parts if they have triangles in common or if this was asked for; then components of a
/// single file are parts, too.
void paste_parts(const MeshArguments& arguments, const Options& options, MeshInput& input);

/// Facets that several files share are no defect; real defects are reported with the indices of the files in
/// order.
void tell_defects_of_files(const MeshArguments& arguments, const MeshInput& input, Result& result);

/// Gives the facets without a marker one marker per smooth patch, and reports their number. Throws UsageError
/// if all have one.
void split_by_angle(const MeshArguments& arguments, Surface& surface);

/// Whether a file may hold a volume whose surface was not asked for.
[[nodiscard]] bool may_need_surface_of(const MeshArguments& arguments);

/// Reports vertices on no facet and no segment: they become vertices of the mesh, which is seldom intended
/// for the inner vertices of a volume that is meshed again.
void tell_of_lone_vertices(const MeshArguments& arguments, const Surface& surface, ProgressView& progress);

/// Reports that sizes of regions in the file are unused, because there are no field points.
void tell_unused_sizes(const MeshArguments& arguments, const Surface& surface);

/// Reports that the background mesh is nowhere near the surface, as it may be if its unit differs.
void tell_field_elsewhere(const MeshArguments& arguments, const Extent& field, const Surface& surface);

/// Sizes in a file without a background mesh belong to the surface's vertices. Throws FileError if their
/// number differs.
void require_a_size_a_vertex(const MeshArguments& arguments, const Options& options, const Surface& surface);

}  // namespace holdfast::cli
