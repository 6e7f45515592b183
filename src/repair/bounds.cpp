#include "repair/bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace holdfast::repairing {

double sum_above(double a, double b) {
  if (a == 0 || b == 0) return a + b;
  return std::nextafter(a + b, std::numeric_limits<double>::infinity());
}

double largest(const std::vector<double>& distances) {
  return distances.empty() ? 0 : *std::max_element(distances.begin(), distances.end());
}

double last_bit(std::span<const Point> points) {
  double most = 0;
  for (const Point& p : points)
    for (const double x : p)
      if (std::isfinite(x)) most = std::max(most, std::fabs(x));
  return std::nextafter(most, std::numeric_limits<double>::infinity()) - most;
}

double extent(std::span<const Point> points) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double most = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double low = kInfinity, high = -kInfinity;
    for (const Point& p : points) {
      if (!std::isfinite(p[k])) continue;
      low = std::min(low, p[k]);
      high = std::max(high, p[k]);
    }
    most = std::max(most, high - low);
  }
  return most;
}

}  // namespace holdfast::repairing
