// Whether an element of second order is positive everywhere.
#pragma once

#include <cstddef>

#include "holdfast/types.h"

namespace holdfast {

/// The Jacobian of a tetrahedron with mid-edge nodes is proven positive everywhere. All its numbers are
/// finite.
[[nodiscard]] bool is_positive_everywhere(const Volume& volume, std::size_t tetrahedron);

}  // namespace holdfast
