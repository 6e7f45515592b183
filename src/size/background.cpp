#include "size/background.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "metric/metric.h"
#include "numbers/elementary.h"
#include "numbers/float_environment.h"
#include "numbers/vector.h"
#include "size/flat_field.h"

namespace holdfast {
namespace {

double six_volumes(const Point& a, const Point& b, const Point& c, const Point& d) {
  return dot(b - a, cross(c - a, d - a));
}

/// The powers of two that scale the largest coordinate along each axis to about 1.
Point scale_of(const std::vector<Point>& points) {
  Point most{};
  for (const Point& p : points)
    for (std::size_t k = 0; k < 3; ++k) most[k] = std::max(most[k], std::abs(p[k]));
  Point scale{1, 1, 1};
  constexpr int kMostExponent = 1022;  // both 2^1022 and 2^-1022 are normal numbers
  for (std::size_t k = 0; k < 3; ++k)
    if (most[k] > 0)
      scale[k] = std::ldexp(1.0, std::clamp(-std::ilogb(most[k]) - 1, -kMostExponent, kMostExponent));
  return scale;
}

}  // namespace

Background::Background(SizeField field) : field_(std::move(field)), scale_(scale_of(field_.vertices)) {
  for (Point& p : field_.vertices) p = scaled(p);
  Point high;
  low_.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const Tetrahedron& t : field_.tetrahedra)
    for (const Index v : t)
      for (std::size_t k = 0; k < 3; ++k) {
        low_[k] = std::min(low_[k], field_.vertices[v][k]);
        high[k] = std::max(high[k], field_.vertices[v][k]);
      }
  // About one bucket a tetrahedron, as close to cubes as the extents allow.
  constexpr double kMostAlong = 512;
  double extent = 0;
  for (std::size_t k = 0; k < 3; ++k) extent = std::max(extent, high[k] - low_[k]);
  const double along =
      std::clamp(numbers::cbrt(static_cast<double>(field_.tetrahedra.size())), 1.0, kMostAlong);
  for (std::size_t k = 0; k < 3; ++k) {
    const double part = extent > 0 ? (high[k] - low_[k]) / extent : 0;
    count_[k] = static_cast<std::size_t>(std::max(1.0, std::ceil(along * part)));
    step_[k] = (high[k] - low_[k]) / static_cast<double>(count_[k]);
  }
  first_.assign(count_[0] * count_[1] * count_[2] + 1, 0);
  for (const Tetrahedron& t : field_.tetrahedra) visit_buckets(t, [&](std::size_t b) { ++first_[b + 1]; });
  for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
  tets_.resize(first_.back());
  std::vector<std::size_t> next = first_;
  for (Index t = 0; t < field_.tetrahedra.size(); ++t)
    visit_buckets(field_.tetrahedra[t], [&](std::size_t b) { tets_[next[b]++] = t; });
}

std::size_t Background::bucket_along(double x, std::size_t axis) const {
  if (!(step_[axis] > 0)) return 0;
  const double k = (x - low_[axis]) / step_[axis];
  if (!(k > 0)) return 0;  // a NaN is not the number of a bucket either
  return static_cast<std::size_t>(std::min(k, static_cast<double>(count_[axis] - 1)));
}

template <typename Visit>
void Background::visit_buckets(const Tetrahedron& t, Visit&& visit) const {
  std::array<std::size_t, 3> from{}, to{};
  for (std::size_t k = 0; k < 3; ++k) {
    double low = field_.vertices[t[0]][k], high = low;
    for (const Index v : t) {
      low = std::min(low, field_.vertices[v][k]);
      high = std::max(high, field_.vertices[v][k]);
    }
    from[k] = bucket_along(low, k);
    to[k] = bucket_along(high, k);
  }
  for (std::size_t z = from[2]; z <= to[2]; ++z)
    for (std::size_t y = from[1]; y <= to[1]; ++y)
      for (std::size_t x = from[0]; x <= to[0]; ++x) visit((z * count_[1] + y) * count_[0] + x);
}

std::optional<Background::Place> Background::locate(const Point& point) const {
  if (tets_.empty()) return {};
  const Point p = scaled(point);
  const std::size_t bucket =
      (bucket_along(p[2], 2) * count_[1] + bucket_along(p[1], 1)) * count_[0] + bucket_along(p[0], 0);
  for (std::size_t k = first_[bucket]; k < first_[bucket + 1]; ++k)
    if (const auto place = place_in(field_.tetrahedra[tets_[k]], p)) return place;
  return {};
}

std::optional<Background::Place> Background::place_in(const Tetrahedron& t, const Point& p) const {
  constexpr double kSlack = 1e-9;  // a point on a face must not fall between two tetrahedra
  const auto& v = field_.vertices;
  const double volume = six_volumes(v[t[0]], v[t[1]], v[t[2]], v[t[3]]);
  if (volume == 0) return {};
  const Place place{
      t,
      {six_volumes(p, v[t[1]], v[t[2]], v[t[3]]) / volume, six_volumes(v[t[0]], p, v[t[2]], v[t[3]]) / volume,
       six_volumes(v[t[0]], v[t[1]], p, v[t[3]]) / volume,
       six_volumes(v[t[0]], v[t[1]], v[t[2]], p) / volume}};
  for (const double part : place.parts)
    if (!(part >= -kSlack && part <= 1 + 4 * kSlack)) return {};
  return place;
}

// The slack of a place may lead out of the range of its corners' sizes, even below zero if these differ much.
double Background::size_at(const Place& place) const {
  double size = 0, least = std::numeric_limits<double>::infinity(), most = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double h = field_.sizes[place.tetrahedron[i]];
    size += place.parts[i] * h;
    least = std::min(least, h);
    most = std::max(most, h);
  }
  return std::clamp(size, least, std::max(least, most));
}

namespace {

std::shared_ptr<const Background> background_of(SizeField field) {
  const auto finite = [](const Point& p) {
    return std::all_of(p.begin(), p.end(), [](double x) { return std::isfinite(x); });
  };
  if (!std::all_of(field.vertices.begin(), field.vertices.end(), finite))
    throw std::invalid_argument("a size field has a coordinate that is not finite");
  for (const Tetrahedron& t : field.tetrahedra)
    for (const Index v : t)
      if (v >= field.vertices.size())
        throw std::invalid_argument("a size field names a vertex it does not have");
  if (is_flat(field))
    throw std::invalid_argument("every tetrahedron of the size field is flat, so it has no sizes anywhere");
  return std::make_shared<const Background>(std::move(field));
}

}  // namespace

std::function<double(const Point&)> size_function(SizeField field) {
  const FloatEnvironment environment;
  if (field.sizes.size() != field.vertices.size())
    throw std::invalid_argument("a size field needs a size for every vertex");
  if (!std::all_of(field.sizes.begin(), field.sizes.end(), [](double h) { return std::isfinite(h); }))
    throw std::invalid_argument("a size field has a size that is not finite");
  return [background = background_of(std::move(field))](const Point& p) {
    const FloatEnvironment environment;
    const auto place = background->locate(p);
    return place ? background->size_at(*place) : 0;
  };
}

std::function<Metric(const Point&)> metric_function(SizeField field) {
  const FloatEnvironment environment;
  if (field.metrics.size() != field.vertices.size() ||
      !std::all_of(field.metrics.begin(), field.metrics.end(), is_positive_definite))
    throw std::invalid_argument("a metric field needs a positive definite tensor for every vertex");
  for (Metric& m : field.metrics) m = logarithm(m);
  return [background = background_of(std::move(field))](const Point& p) {
    const FloatEnvironment environment;
    const auto place = background->locate(p);
    if (!place) return Metric{};
    Metric sum{};
    for (std::size_t i = 0; i < 4; ++i)
      sum = sum + place->parts[i] * background->metric(place->tetrahedron[i]);
    return exponential(sum);
  };
}

}  // namespace holdfast
