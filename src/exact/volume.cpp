#include "exact/volume.h"

namespace holdfast::exact {

Dyadic determinant(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, const ExactPoint& d) {
  std::array<std::array<Dyadic, 3>, 3> m;
  for (std::size_t k = 0; k < 3; ++k) {
    m[0][k] = b.c[k] - a.c[k];
    m[1][k] = c.c[k] - a.c[k];
    m[2][k] = d.c[k] - a.c[k];
  }
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) +
         m[0][1] * (m[1][2] * m[2][0] - m[1][0] * m[2][2]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

}  // namespace holdfast::exact
