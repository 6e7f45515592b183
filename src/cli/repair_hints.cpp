#include "repair_hints.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace holdfast::cli {
namespace {

/// The unit in the last place of the largest coordinate.
double last_bit(const Surface& surface) {
  double most = 0;
  for (const Point& p : surface.vertices)
    for (const double x : p)
      if (std::isfinite(x)) most = std::max(most, std::fabs(x));
  return std::nextafter(most, std::numeric_limits<double>::infinity()) - most;
}

/// The share of all triangle sides that are not longer than `length`.
double share_of_sides(const Surface& surface, double length) {
  std::size_t sides = 0, shorter = 0;
  for (const Triangle& t : surface.facets)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index v = t[i], w = t[(i + 1) % 3];
      if (v >= surface.vertices.size() || w >= surface.vertices.size()) continue;
      const Point &p = surface.vertices[v], &q = surface.vertices[w];
      ++sides;
      shorter += std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) <= length ? 1 : 0;
    }
  return sides == 0 ? 0 : static_cast<double>(shorter) / static_cast<double>(sides);
}

/// The least power of ten that is not less than `length`.
double power_of_ten_above(double length) { return std::pow(10, std::ceil(std::log10(length))); }

}  // namespace

std::string what_may_help(const Surface& given, const RepairOptions& options) {
  if (options.join > 0) return fmt::format("less than --join {}, or none, may help", options.join);
  if (options.weld > 0) {
    constexpr double kMany = 0.1;
    const double share = share_of_sides(given, options.weld);
    if (share >= kMany)
      return fmt::format("{:.0f} % of all sides are no longer than --weld {}: less, or none, may help",
                         100 * share, options.weld);
    return fmt::format("another length than --weld {}, or none, may help", options.weld);
  }
  // As a last resort, `repair` has already merged vertices this close.
  constexpr double kTried = 0x1p32;
  const double tried = kTried * last_bit(given);
  return fmt::format(
      "vertices that are within {:.2g} of each other were made one to no avail: --weld {:g} may help", tried,
      power_of_ten_above(2 * tried));
}

std::string told_below_last_bit(const Surface& given, double weld) {
  const double bit = last_bit(given);
  if (weld == 0 || weld >= bit) return {};
  return fmt::format(
      "--weld {} is less than the last bit of the largest coordinate, {:.2g}: vertices with such coordinates "
      "are not that near",
      weld, bit);
}

}  // namespace holdfast::cli
