// The mesher for callers within the library.
#pragma once

#include "classify/parts.h"
#include "holdfast/holdfast.h"

namespace holdfast {

/// `mesh` of a complex whose vertices are not merged, for parts of a volume: two at one place are a defect.
[[nodiscard]] Result mesh_as_given(const Complex& complex, const Options& options);

/// `mesh` of a pasted complex. Fills `parts.overlaps`.
[[nodiscard]] Result mesh_parts(const Complex& complex, const Options& options, PartsOfComplex& parts);

}  // namespace holdfast
