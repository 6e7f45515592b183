#include "api/judge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>

#include "classify/keep.h"
#include "holdfast/region_bounds.h"
#include "holdfast/regular_tetrahedron.h"
#include "numbers/finite.h"
#include "surface/whereabouts.h"

namespace holdfast {

namespace {

void require(bool sensible, const char* otherwise) {
  if (!sensible) throw std::invalid_argument(otherwise);
}

constexpr unsigned kMostLayers = 100;  // levels are counted in eight bits (refine/levels.h)

// The same test serves for a volume.
bool is_length_or_none(double x) { return x >= 0 && std::isfinite(x); }

void require_sensible_sizes(const Complex& complex, const Sizes& sizes) {
  require(is_length_or_none(sizes.size), "a size must be finite and not negative");
  require(is_length_or_none(sizes.max_volume), "a largest volume must be finite and not negative");
  require(
      sizes.max_ratio == 0 || (sizes.max_ratio > regular_radius_ratio && std::isfinite(sizes.max_ratio)),
      "the largest ratio of radii to edges must be finite and above that of a regular tetrahedron, 0.6124");
  require(sizes.layers <= kMostLayers, "at most 100 layers can be asked for");
  require(!sizes.gradation || (*sizes.gradation >= 0 && *sizes.gradation <= 1),
          "the gradation must lie between 0 and 1");
  require(sizes.vertex_sizes.empty() || sizes.vertex_sizes.size() == complex.vertices.size(),
          "as many sizes as vertices are needed, or none");
  require(std::all_of(sizes.vertex_sizes.begin(), sizes.vertex_sizes.end(), is_length_or_none),
          "sizes of vertices must be finite and not negative");
}

// The corners of the box lie beyond all vertices.
bool has_room_for_box(const Complex& complex) {
  constexpr double kMost = std::numeric_limits<double>::max();
  return std::none_of(complex.vertices.begin(), complex.vertices.end(), [](const Point& p) {
    return std::any_of(p.begin(), p.end(), [](double x) { return std::abs(x) == kMost; });
  });
}

// The corners of a kept box lie within this one, whatever their rounding.
bool is_far_outside(const Point& p, const Complex& complex, double margin) {
  if (complex.vertices.empty()) return false;
  Point low = complex.vertices[0], high = low;
  for (const Point& v : complex.vertices)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], v[k]);
      high[k] = std::max(high[k], v[k]);
    }
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  const double room = 2 * margin * extent;
  for (std::size_t k = 0; extent > 0 && k < 3; ++k)
    if (p[k] < low[k] - room || p[k] > high[k] + room) return true;
  return false;
}

// A vertex of an open border in the region of `seed`: facets that end there may once have divided the region.
// If only little is missing, the ends of a border edge lie on the rest of the surface, and only its inside
// does not.
std::optional<Index> open_border_beside(const Complex& complex, const SegmentTable& table, const Point& seed,
                                        const std::function<void()>& step) {
  const std::vector<char> gone = peeled_from_borders(table);
  std::vector<Triangle> closed;
  for (Index f = 0; f < complex.facets.size(); ++f)
    if (!gone[f]) closed.push_back(complex.facets[f]);
  std::vector<Point> points{seed};
  std::vector<Index> border{no_index};
  for (Index s = 0; s < table.segments.size(); ++s) {
    if (table.facets_of(s).size() != 1) continue;
    const auto [a, b] = table.segments[s];
    const Point &p = complex.vertices[a], &q = complex.vertices[b];
    border.insert(border.end(), {a, b, a});
    points.insert(points.end(), {p, q, {p[0] / 2 + q[0] / 2, p[1] / 2 + q[1] / 2, p[2] / 2 + q[2] / 2}});
  }
  const Complex rest{complex.vertices, closed, {}, {}, {}};
  const std::vector<Whereabouts> where = whereabouts(rest, Separation(segment_table(rest)), points, step);
  for (std::size_t i = 1; i < where.size(); ++i)
    if (!where[i].on_facet && where[i].region == where[0].region) return border[i];
  return std::nullopt;
}

void require_seeds_agree(const Complex& complex, const SegmentTable& table, std::span<const RegionSeed> seeds,
                         std::span<const Whereabouts> holes, std::span<const Whereabouts> where,
                         const VertexNames& names, const std::function<void()>& step) {
  std::map<Separation::Region, int> ids;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const Separation::Region& region = where[i].region;
    if (std::any_of(holes.begin(), holes.end(), [&](const Whereabouts& h) { return h.region == region; }))
      throw in_region_not_kept(seeds[i].where);
    const int id = ids.try_emplace(region, seeds[i].id).first->second;
    if (id == seeds[i].id) continue;
    throw with_two_ids(seeds[i], id, complex, open_border_beside(complex, table, seeds[i].where, step),
                       names);
  }
}

}  // namespace

void require_sensible(const Complex& complex, const Options& options) {
  require(complex.vertex_markers.empty() || complex.vertex_markers.size() == complex.vertices.size(),
          "as many vertex markers as vertices are needed, or none");
  require(complex.facet_markers.empty() || complex.facet_markers.size() == complex.facets.size(),
          "as many facet markers as facets are needed, or none");
  require(complex.segment_markers.empty() || complex.segment_markers.size() == complex.segments.size(),
          "as many segment markers as segments are needed, or none");
  require(std::all_of(options.holes.begin(), options.holes.end(), is_finite),
          "a hole has a coordinate that is not finite");
  for (const RegionSeed& seed : options.regions) {
    require(is_finite(seed.where) || is_bound_alone(seed),
            "a region seed has a coordinate that is not finite");
    require(is_length_or_none(seed.size), "the size of a region must be finite and not negative");
    require(is_length_or_none(seed.max_volume),
            "the largest volume of a region must be finite and not negative");
  }
  if (options.sizes) require_sensible_sizes(complex, *options.sizes);
  require(options.keep != Keep::box || (options.box_margin > 0 && options.box_margin < 1e6),
          "the margin of the box must be positive and below a million");
  require(options.keep != Keep::box || has_room_for_box(complex),
          "no box is larger than a surface that reaches to the largest double");
  require(options.time_limit >= 0, "the time limit must not be negative");
}

void require_well_placed(const Complex& complex, const SegmentTable& table, const Options& options,
                         const VertexNames& names, const std::function<void()>& step) {
  std::vector<Point> points = options.holes;
  std::vector<RegionSeed> seeds = options.regions;
  std::erase_if(seeds, is_bound_alone);
  for (const RegionSeed& seed : seeds) points.push_back(seed.where);
  if (points.empty() || options.stop_after.value_or(Stage::optimise) < Stage::classify) return;
  const std::vector<Whereabouts> where = whereabouts(complex, Separation(table), points, step);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const char* const what = i < options.holes.size() ? "hole" : "region seed";
    if (where[i].on_facet) throw on_the_surface(what, points[i]);
    const bool is_outside = options.keep == Keep::box ? is_far_outside(points[i], complex, options.box_margin)
                                                      : where[i].region.empty();
    if (is_outside) throw in_no_region(what, points[i]);
  }
  const auto holes = std::span(where).first(options.holes.size());
  require_seeds_agree(complex, table, seeds, holes, std::span(where).subspan(holes.size()), names, step);
}

}  // namespace holdfast
