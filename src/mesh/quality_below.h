// The paper's Q if it is below a limit.
#pragma once

#include <optional>

#include "mesh/quality.h"

namespace holdfast {

/// quality(a, b, c, d) if it is below `limit`, which is above 1. Tetrahedra surely above the limit are
/// rejected quickly, because the exact quality of flat tetrahedra takes long.
[[nodiscard]] std::optional<double> quality_below(const Point& a, const Point& b, const Point& c,
                                                  const Point& d, double limit);

/// Only whether Q is below the limit. Computes the exact quality only near the limit.
[[nodiscard]] bool is_quality_below(const Point& a, const Point& b, const Point& c, const Point& d,
                                    double limit);

}  // namespace holdfast
