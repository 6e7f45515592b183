// Points: explicit or exact.
#include "exact/point.h"

namespace holdfast::exact {

ExactPoint lift(const double* p) { return {{Dyadic(p[0]), Dyadic(p[1]), Dyadic(p[2])}}; }

ExactPoint lift(PointRef p) { return p.exact != nullptr ? *p.exact : lift(p.approx); }

void difference(PointRef a, PointRef b, double out[3]) {
  for (int i = 0; i < 3; ++i) {
    if (a.exact == nullptr && b.exact == nullptr) {
      out[i] = a.approx[i] - b.approx[i];  // IEEE subtraction rounds the exact difference
      continue;
    }
    const auto k = static_cast<std::size_t>(i);
    const Dyadic ai = a.exact != nullptr ? a.exact->c[k] : Dyadic(a.approx[i]);
    const Dyadic bi = b.exact != nullptr ? b.exact->c[k] : Dyadic(b.approx[i]);
    out[i] = (ai - bi).to_double();
  }
}

}  // namespace holdfast::exact
