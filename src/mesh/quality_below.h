// The paper's Q where it is below a limit.
#pragma once

#include <optional>

#include "mesh/quality.h"

namespace holdfast {

/// quality(a, b, c, d) where that is below `limit`, which is above 1; what surely is not takes less time, for
/// the exact quality of flat tetrahedra takes long.
[[nodiscard]] std::optional<double> quality_below(const Point& a, const Point& b, const Point& c,
                                                  const Point& d, double limit);

/// The same for whom Q itself does not matter, which takes no exact quality unless it is near the limit.
[[nodiscard]] bool is_quality_below(const Point& a, const Point& b, const Point& c, const Point& d,
                                    double limit);

}  // namespace holdfast
