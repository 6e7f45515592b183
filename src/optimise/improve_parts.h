// Improves the parts of a large volume at the same time.
#pragma once

#include <memory>
#include <optional>

#include "mesh/parallel.h"
#include "optimise/improve.h"
#include "refine/parts.h"
#include "size/size_function.h"

namespace holdfast {

/// Parts of a mesh that add_field_points left, and the sizes of the points that are missing.
struct FilledParts {
  std::unique_ptr<Parts> parts;
  const SizeFunction& sizes;
};

/// As `improve`, but a large mesh is cut into parts, unless it comes in parts. After the parts are joined,
/// the elements near the cuts are filled and improved in the same way, in parts again while they are many,
/// because they could not be changed before. The number of threads makes no difference to the result.
ImproveStats improve_in_parts(const VolumeData& volume, std::optional<FilledParts> filled, Extent extent,
                              const Threads& threads, Monitor& monitor);

/// Continues from the result of less effort, as far as `extent` goes, and makes none of the figures of the
/// volume (figures.h) worse; `figures` are the current ones, if known. Progress is reported as that part of
/// the stage's work. A large mesh is cut into parts. Each keeps the figures of the whole as if the others
/// stayed as they are; as all but the least angle are means, the parts keep them together.
ImproveStats improve_further_in_parts(const VolumeData& volume, Extent extent, std::optional<Figures> figures,
                                      std::array<double, 2> work, const Threads& threads, Monitor& monitor);

}  // namespace holdfast
