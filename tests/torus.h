// A torus: many sets of four vertices lie on one circle, up to rounding.
#pragma once

#include <cmath>
#include <numbers>

#include "holdfast/types.h"

namespace holdfast {

inline Surface torus(Index around, Index across) {
  Surface surface;
  for (Index i = 0; i < around; ++i)
    for (Index j = 0; j < across; ++j) {
      const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * j / across;
      const double r = 1 + 0.4 * std::cos(b);
      surface.vertices.push_back({r * std::cos(a), r * std::sin(a), 0.4 * std::sin(b)});
      const Index p = i * across + j, q = (i + 1) % around * across + j;
      const Index s = i * across + (j + 1) % across, r2 = (i + 1) % around * across + (j + 1) % across;
      surface.facets.push_back({p, q, r2});
      surface.facets.push_back({p, r2, s});
    }
  return surface;
}

}  // namespace holdfast
