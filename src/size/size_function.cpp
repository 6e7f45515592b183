#include "size/size_function.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

#include "holdfast/region_bounds.h"
#include "holdfast/regular_tetrahedron.h"
#include "numbers/elementary.h"
#include "size/tuning.h"

namespace holdfast {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();
constexpr std::size_t kFacetsAPoll = 1 << 16;  // some milliseconds

// The edge of the regular tetrahedron with this volume. Elements of a field mesh vary in volume; most have
// less than a regular one with edges of the wanted size.
double size_of_volume(double volume) {
  return volume < kNoLimit ? regular_edge_of_volume_one * numbers::cbrt(volume) : kNoLimit;
}

Point times_power(const Point& p, int k) {
  return {std::ldexp(p[0], k), std::ldexp(p[1], k), std::ldexp(p[2], k)};
}

double length_of(const Segment& s, const Complex& complex, int scale) {
  const Point &a = complex.vertices[s[0]], &b = complex.vertices[s[1]];
  return scale == 0 ? numbers::distance(a, b)
                    : numbers::distance(times_power(a, scale), times_power(b, scale));
}

// The edges at a vertex.
struct Lengths {
  double sum = 0, squares = 0, least = kNoLimit, most = 0;
  double count = 0;

  void add(double length) {
    sum += length;
    squares += length * length;
    least = std::min(least, length);
    most = std::max(most, length);
    ++count;
  }
  // Where some edges are far longer than others, the long ones count for more: the root of the mean square.
  [[nodiscard]] double size() const {
    if (count == 0) return kNoLimit;
    return most > tuning::kUnlike * least ? std::sqrt(squares / count) : sum / count;
  }
};

// The size that the edges at each vertex ask for, times 2^scale, at which lengths neither over- nor
// underflow.
std::vector<double> edge_lengths(const Complex& complex, const SegmentTable& table, int scale) {
  std::vector<Lengths> lengths(complex.vertices.size());
  for (const Segment& s : table.segments) {
    const double length = length_of(s, complex, scale);
    for (const Index v : s) lengths[v].add(length);
  }
  std::vector<double> sizes(lengths.size());
  std::transform(lengths.begin(), lengths.end(), sizes.begin(), [](const Lengths& l) { return l.size(); });
  return sizes;
}

// The share of the vertices whose sizes grow along some edge by more than its length.
double share_of_steep(std::span<const double> of_vertex, const Complex& complex, const SegmentTable& table,
                      int scale) {
  std::vector<std::uint8_t> has_edge(of_vertex.size(), 0), is_steep(of_vertex.size(), 0);
  for (const Segment& s : table.segments) {
    for (const Index v : s) has_edge[v] = 1;
    const Index smaller = of_vertex[s[0]] < of_vertex[s[1]] ? s[0] : s[1];
    if (std::abs(of_vertex[s[1]] - of_vertex[s[0]]) > length_of(s, complex, scale)) is_steep[smaller] = 1;
  }
  const auto steep = std::count(is_steep.begin(), is_steep.end(), 1),
             all = std::count(has_edge.begin(), has_edge.end(), 1);
  return static_cast<double>(steep) / static_cast<double>(std::max<std::ptrdiff_t>(all, 1));
}

// No size inside is larger: a bound on those of the vertices and their growth over the whole extent.
double largest_size(std::span<const double> of_vertex, double gradation, const Complex& complex, int scale) {
  double largest = 0;
  Point low{kNoLimit, kNoLimit, kNoLimit}, high{-kNoLimit, -kNoLimit, -kNoLimit};
  for (std::size_t v = 0; v < of_vertex.size(); ++v) {
    if (!(of_vertex[v] < kNoLimit)) continue;
    largest = std::max(largest, of_vertex[v]);
    const Point p = times_power(complex.vertices[v], scale);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  return largest > 0 ? largest + gradation * numbers::distance(low, high) : kNoLimit;
}

// Where the sizes of the surface grow much faster than those inside, as on surfaces full of needles, slow
// growth would fill the volume with small elements and improve few of them.
double default_gradation(double steepness) {
  return tuning::kGradation + (tuning::kGradationOfSteep - tuning::kGradation) * steepness;
}

void require_regions_of_bounds(std::span<const RegionSeed> seeds, const Kept& kept) {
  std::set<int> ids;
  for (std::size_t r = 0; r < kept.id.size(); ++r)
    if (kept.region[r]) ids.insert(kept.id[r]);
  for (const RegionSeed& seed : seeds) {
    if (!is_bound_alone(seed) || ids.contains(seed.id)) continue;
    std::string known;
    for (const int id : ids) known += (known.empty() ? "" : ", ") + std::to_string(id);
    throw std::invalid_argument("a largest volume is given for region " + std::to_string(seed.id) +
                                ", which the mesh does not have; its regions are " + known);
  }
}

}  // namespace

SizeFunction::SizeFunction(const Sizes& sizes, std::span<const RegionSeed> seeds, const Complex& complex,
                           const SegmentTable& table, const Kept& kept, int scale, const Threads& threads)
    : gradation_(sizes.gradation.value_or(tuning::kGradation)),
      grows_(sizes.grow),
      is_given_at_vertices_(!sizes.vertex_sizes.empty()),
      scale_(scale),
      of_region_(kept.region.size(), sizes.size > 0 ? std::ldexp(sizes.size, scale) : kNoLimit),
      field_(sizes.field),
      fields_(sizes.fields),
      metric_(sizes.metric),
      is_concurrent_(sizes.concurrent),
      of_vertex_(edge_lengths(complex, table, scale)) {
  threads.poll();
  for (std::size_t v = 0; v < std::min(of_vertex_.size(), sizes.vertex_sizes.size()); ++v)
    if (sizes.vertex_sizes[v] > 0) of_vertex_[v] = std::ldexp(sizes.vertex_sizes[v], scale);
  if (sizes.vertex_sizes.empty() && !metric_) {
    const double share = share_of_steep(of_vertex_, complex, table, scale);
    steepness_ = std::clamp((share - tuning::kFewSteep) / (tuning::kManySteep - tuning::kFewSteep), 0.0, 1.0);
    if (!sizes.gradation) gradation_ = default_gradation(steepness_);
  }
  if (fields_ && !field_)
    field_ = [fields = fields_](const Point& p) {
      double h = 0;
      fields({&p, 1}, {&h, 1});
      return h;
    };
  limit_regions(sizes, seeds, kept);
  // A box round the surface may be much larger than its extent. Elsewhere a limit above all sizes is none.
  if (has_limit_of_region_ && kept.rule != Keep::box && !field_ && !metric_ && most_volumes_.empty()) {
    const double largest = largest_size(of_vertex_, gradation_, complex, scale);
    std::replace_if(
        of_region_.begin(), of_region_.end(), [&](double h) { return h >= largest; }, kNoLimit);
    has_limit_of_region_ =
        std::any_of(of_region_.begin(), of_region_.end(), [](double h) { return h < kNoLimit; });
  }
  // A metric is obeyed as given, and a bound on volumes is exact.
  if (heeds_facets()) of_facets_ = sizes_of_facets(complex, threads);
}

SizeFunction SizeFunction::with_limits_times(std::span<const double> factor_of_region,
                                             double part_of_most_need, const Complex& complex,
                                             const Threads& threads) const {
  SizeFunction other = *this;
  other.part_of_most_need_ = part_of_most_need;
  other.factor_of_region_.assign(factor_of_region.begin(), factor_of_region.end());
  for (std::size_t r = 0; r < other.of_region_.size(); ++r) other.of_region_[r] *= factor_of_region[r];
  if (heeds_facets()) other.of_facets_ = other.sizes_of_facets(complex, threads);
  return other;
}

FacetSizes SizeFunction::sizes_of_facets(const Complex& complex, const Threads& threads) const {
  double least = kNoLimit;
  for (const double h : of_region_) least = std::min(least, h);
  std::vector<FacetSizes::Facet> facets;
  facets.reserve(complex.facets.size());
  for (const Triangle& t : complex.facets) {
    FacetSizes::Facet f{{}, least};
    for (std::size_t i = 0; i < 3; ++i) {
      f.corners[i] = times_power(complex.vertices[t[i]], scale_);
      f.wanted = std::min(f.wanted, of_vertex_[t[i]]);
    }
    f.is_asked = f.wanted == least;
    facets.push_back(f);
    if (facets.size() % kFacetsAPoll == 0) threads.poll();
  }
  // A function may want any size anywhere.
  return FacetSizes(facets, field_ ? FacetSizes::Wanted::anywhere : FacetSizes::Wanted::at_corners, threads,
                    part_of_most_need_);
}

void SizeFunction::limit_regions(const Sizes& sizes, std::span<const RegionSeed> seeds, const Kept& kept) {
  const auto bounds = [](const RegionSeed& seed) { return seed.max_volume > 0; };
  const auto volume = [&](double v) { return v > 0 ? std::ldexp(v, 3 * scale_) : kNoLimit; };
  require_regions_of_bounds(seeds, kept);
  const bool has_bound = sizes.max_volume > 0 || std::any_of(seeds.begin(), seeds.end(), bounds);
  if (has_bound) most_volumes_.assign(kept.id.size(), volume(sizes.max_volume));
  for (std::size_t r = 0; r < kept.id.size(); ++r) {
    if (!kept.region[r]) continue;
    for (const RegionSeed& seed : seeds) {
      if (kept.id[r] != seed.id) continue;
      if (seed.size > 0) of_region_[r] = std::min(of_region_[r], std::ldexp(seed.size, scale_));
      if (seed.max_volume > 0) most_volumes_[r] = std::min(most_volumes_[r], volume(seed.max_volume));
    }
    if (has_bound) of_region_[r] = std::min(of_region_[r], size_of_volume(most_volumes_[r]));
  }
  has_limit_of_region_ =
      std::any_of(of_region_.begin(), of_region_.end(), [](double h) { return h < kNoLimit; });
}

Point SizeFunction::unscaled(const Point& p) const { return times_power(p, -scale_); }

double SizeFunction::scaled(double h) const { return h > 0 ? std::ldexp(h, scale_) : kNoLimit; }

double SizeFunction::field_at(const Point& p) const { return scaled(field_(unscaled(p))); }

void SizeFunction::limits(std::span<const Point> points, std::span<const RegionId> regions,
                          std::span<double> limits) const {
  if (!fields_) {
    for (std::size_t k = 0; k < points.size(); ++k) limits[k] = limit(points[k], regions[k]);
    return;
  }
  std::vector<Point> unscaled_points(points.size());
  std::transform(points.begin(), points.end(), unscaled_points.begin(),
                 [this](const Point& p) { return unscaled(p); });
  fields_(unscaled_points, limits);
  for (std::size_t k = 0; k < points.size(); ++k)
    limits[k] = std::min(of_region_[regions[k]], scaled(limits[k]));
}

Metric SizeFunction::metric(const Point& p, double most) const {
  const Metric of_limit = most < kNoLimit ? isotropic_metric(most) : Metric{};
  Metric m = metric_(unscaled(p));
  for (double& x : m) x = std::ldexp(x, -2 * scale_);
  return is_positive_definite(m) ? intersection(m, of_limit) : of_limit;
}

}  // namespace holdfast
