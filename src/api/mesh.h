// The mesher as the library itself calls it.
#pragma once

#include "holdfast/holdfast.h"

namespace holdfast {

/// `mesh` of a complex whose vertices stay as they are, for parts of a volume: two at one place are a defect.
[[nodiscard]] Result mesh_as_given(const Complex& complex, const Options& options);

}  // namespace holdfast
