// Shape of the elements inside, for reports, and which of them are flat.
#pragma once

#include <array>

#include "mesh/parallel.h"
#include "mesh/shape_counts.h"
#include "optimise/energy.h"
#include "refine/parts.h"

namespace holdfast {

inline constexpr double kEnergyOfFlat = energy_of_sine(tuning::kSineOfFlat);
/// Whether a tetrahedron is nearly flat: needles have a large Q, too, but no such angle.
[[nodiscard]] bool is_flat(const Point& a, const Point& b, const Point& c, const Point& d);

/// Of the tetrahedra of the kept regions, as the metric sees them if there is one.
[[nodiscard]] ShapeCounts shape_of(const VolumeData& volume, const Threads& threads = 1);

/// The same for a mesh in parts.
[[nodiscard]] ShapeCounts shape_of(Parts& parts, const Threads& threads = 1);

/// Lengths of their edges, in the metric if there is one, over the mean of the sizes at the ends: in bins of
/// an eighth, the last without an end.
[[nodiscard]] std::array<std::size_t, 24> edge_lengths_of(const VolumeData& volume,
                                                          const Threads& threads = 1);

}  // namespace holdfast
