// Surface layer: oriented boxes and their separating axes.
#include "surface/oriented_box.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numbers/vector.h"

namespace holdfast {
namespace {

// Unit coordinates err by about 2^-52, axes and sums of a few products by little more.
constexpr double kMargin = 1e-13;

Point times(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }

// The part of `v` orthogonal to the unit vector `u`, normalised; if it is too short to be accurate, any
// orthogonal direction.
Point orthogonal(const Point& v, const Point& u) {
  const double size = length(v);
  if (size > 0) {
    const Point w = times(1 / size, v);
    const Point rest = w - times(dot(w, u), u);
    if (length(rest) > 0.5) {
      const Point again = rest - times(dot(rest, u), u);
      return times(1 / length(again), again);
    }
  }
  Point least{0, 0, 0};
  const auto smaller = [](double a, double b) { return std::fabs(a) < std::fabs(b); };
  least[static_cast<std::size_t>(std::min_element(u.begin(), u.end(), smaller) - u.begin())] = 1;
  const Point rest = least - times(dot(least, u), u);
  return times(1 / length(rest), rest);
}

std::array<Point, 3> axes_of(const std::vector<std::array<Point, 3>>& corners) {
  Point longest{0, 0, 0}, normal{0, 0, 0};
  double best = 0;
  for (const auto& t : corners) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Point side = t[(i + 1) % 3] - t[i];
      const double size = dot(side, side);
      if (!(size > best)) continue;
      best = size;
      longest = side;
      normal = cross(side, t[(i + 2) % 3] - t[i]);
    }
  }
  const double size = length(longest);
  const Point u = size > 0 ? times(1 / size, longest) : Point{1, 0, 0};
  const Point n = orthogonal(normal, u);
  return {u, n, cross(u, n)};
}

}  // namespace

UnitFrame::UnitFrame(const Box& box) {
  double extent = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    origin_[k] = box.low[k] / 2 + box.high[k] / 2;
    extent = std::max(extent, box.high[k] / 2 - box.low[k] / 2);
  }
  scale_ = 1 / extent;
}

Point UnitFrame::operator()(const double* p) const {
  return {(p[0] - origin_[0]) * scale_, (p[1] - origin_[1]) * scale_, (p[2] - origin_[2]) * scale_};
}

OrientedBox oriented_box(const std::vector<std::array<Point, 3>>& corners) {
  OrientedBox box;
  box.axis = axes_of(corners);
  for (std::size_t k = 0; k < 3; ++k) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& t : corners) {
      for (const Point& p : t) {
        const double at = dot(p, box.axis[k]);
        low = std::min(low, at);
        high = std::max(high, at);
      }
    }
    box.half[k] = (high - low) / 2 + kMargin;
    for (std::size_t j = 0; j < 3; ++j) box.centre[j] += (low + high) / 2 * box.axis[k][j];
  }
  return box;
}

bool surely_apart(const OrientedBox& a, const OrientedBox& b) {
  const Point between = b.centre - a.centre;
  double cosine[3][3], size[3][3];
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      cosine[i][j] = dot(a.axis[i], b.axis[j]);
      size[i][j] = std::fabs(cosine[i][j]) + kMargin;
    }
  }
  // A comparison with NaN (from coordinates at the end of the range) is false, which means "not sure".
  double on_a[3];
  for (std::size_t i = 0; i < 3; ++i) {
    on_a[i] = dot(between, a.axis[i]);
    const double reach = a.half[i] + b.half[0] * size[i][0] + b.half[1] * size[i][1] + b.half[2] * size[i][2];
    if (std::fabs(on_a[i]) > reach + kMargin) return true;
  }
  for (std::size_t j = 0; j < 3; ++j) {
    const double reach = b.half[j] + a.half[0] * size[0][j] + a.half[1] * size[1][j] + a.half[2] * size[2][j];
    if (std::fabs(dot(between, b.axis[j])) > reach + kMargin) return true;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double reach = a.half[i1] * size[i2][j] + a.half[i2] * size[i1][j] + b.half[j1] * size[i][j2] +
                           b.half[j2] * size[i][j1];
      if (std::fabs(on_a[i2] * cosine[i1][j] - on_a[i1] * cosine[i2][j]) > reach + kMargin) return true;
    }
  }
  return false;
}

}  // namespace holdfast
