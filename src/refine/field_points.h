// Field points: points inside the regions so that edges get the length that a size function asks for
// (docs/sizes.md; paper §9).
#pragma once

#include <memory>

#include "mesh/monitor.h"
#include "mesh/parallel.h"
#include "refine/parts.h"
#include "refine/volume_data.h"
#include "size/size_function.h"

namespace holdfast {

struct FieldPoints {
  std::unique_ptr<Parts> parts;  ///< of a large mesh, to go on with
  bool stopped_early = false;    ///< see `advance_front`
};

/// Adds field points to the kept regions; all vertices of their tetrahedra are explicit. Facets, segments and
/// vertices stand. Sets the size at each vertex of the mesh. Tetrahedra, and the vertices that lie on no
/// constraint, follow a Morton curve afterwards.
///
/// A large mesh is left in parts, to go on with; points near the interfaces between them are missing. The
/// threads make no difference to the result.
[[nodiscard]] FieldPoints add_field_points(const VolumeData& volume, const SizeFunction& sizes,
                                           const Threads& threads, Monitor& monitor);

struct FilledIn {
  std::size_t points = 0;
  bool stopped_early = false;
};

/// Adds field points inside parts, which have none yet. `work` is the part of the stage's work that this is.
FilledIn fill_parts(Parts& parts, const SizeFunction& sizes, Stage stage, std::array<double, 2> work,
                    const Threads& threads, Monitor& monitor);

/// Joins parts and adds the points that are missing. Returns whether that stopped early.
bool join_filled(std::unique_ptr<Parts> parts, const SizeFunction& sizes, const Threads& threads,
                 Monitor& monitor);

}  // namespace holdfast
