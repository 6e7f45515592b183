// The mesher as the library itself calls it.
#pragma once

#include "classify/parts.h"
#include "holdfast/holdfast.h"

namespace holdfast {

/// `mesh` of a complex whose vertices stay as they are, for parts of a volume: two at one place are a defect.
[[nodiscard]] Result mesh_as_given(const Complex& complex, const Options& options);

/// `mesh` of a complex that was pasted together. Fills `parts.overlaps`.
[[nodiscard]] Result mesh_parts(const Complex& complex, const Options& options, PartsOfComplex& parts);

}  // namespace holdfast
