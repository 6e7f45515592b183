// Whether an element of second order is positive everywhere.
#pragma once

#include <cstddef>

#include "holdfast/types.h"

namespace holdfast {

/// Whether the Jacobian of a tetrahedron with mid-edge nodes is proven positive everywhere. All coordinates
/// must be finite.
[[nodiscard]] bool is_positive_everywhere(const Volume& volume, std::size_t tetrahedron);

}  // namespace holdfast
