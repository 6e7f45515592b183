// The size that edges should have: from the surface, and from what the user asks for (paper §9;
// docs/sizes.md).
//
// A vertex of the surface has the mean length of the edges of its facets (of very unlike ones the root of the
// mean square), or what the user gave for it. A size spreads inward: from a vertex of size h, at distance d,
// it is at most h + gradation * d. The default gradation is larger where the sizes of the surface themselves
// jump. A point gets the least that the vertices round it allow, so that sizes are handed from point to point
// as the mesh grows, and no other structure is needed. On top of this come the user's limits: one number, one
// a region, a field. A largest volume limits sizes, too, so that few tetrahedra are larger when all else is
// done.
//
// With a metric of the user, sizes depend on the direction. Only the largest of them is passed
// from point to point. So the metric is used unchanged except where it exceeds, in some direction, what all
// this allows. Passing on the metric itself would spoil it where its axes turn, as along a curved layer.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "classify/keep.h"
#include "holdfast/holdfast.h"
#include "mesh/parallel.h"
#include "metric/metric.h"
#include "size/facet_sizes.h"
#include "surface/complex.h"

namespace holdfast {

class SizeFunction {
 public:
  /// `seeds` may give the regions that are kept sizes of their own. The mesh is the complex times 2^scale.
  SizeFunction(const Sizes& sizes, std::span<const RegionSeed> seeds, const Complex& complex,
               const SegmentTable& table, const Kept& kept, int scale, const Threads& threads = 1);

  /// The same with smaller sizes than the user asks for: the limit of each region times a factor, and this
  /// part of what large facets may need.
  [[nodiscard]] SizeFunction with_limits_times(std::span<const double> factor_of_region,
                                               double part_of_most_need, const Complex& complex,
                                               const Threads& threads = 1) const;

  /// Of a vertex of the complex; infinite for one without edges.
  [[nodiscard]] std::size_t vertex_count() const { return of_vertex_.size(); }
  [[nodiscard]] double of_vertex(Vertex v) const { return of_vertex_[v]; }
  /// What the user allows at a point of the mesh in a region; infinite without a limit there.
  [[nodiscard]] double limit(const Point& p, RegionId region) const {
    const double least = of_region_[region];
    return field_ ? std::min(least, field_at(p)) : least;
  }
  /// The same at several points, each in a region of its own.
  void limits(std::span<const Point> points, std::span<const RegionId> regions,
              std::span<double> limits) const;
  /// Whether a function of the user is to be asked for limits: at many points at a time, it is asked less
  /// often.
  [[nodiscard]] bool has_field() const { return static_cast<bool>(field_); }
  [[nodiscard]] bool has_metric() const { return static_cast<bool>(metric_); }
  /// The metric of the user at a point of the mesh, with no size above `most`; zero without either.
  [[nodiscard]] Metric metric(const Point& p, double most) const;
  /// What the user asks for in a region where `size` is what a limit of it leaves.
  [[nodiscard]] double asked_for(double size, RegionId region) const {
    return factor_of_region_.empty() ? size : size / factor_of_region_[region];
  }
  /// Whether the user gave a limit anywhere.
  [[nodiscard]] bool has_limit() const { return field_ || has_limit_of_region_; }
  /// Those of the threads that may ask for sizes: a function of the user is called on the calling one alone,
  /// unless it may be called on several.
  [[nodiscard]] Threads threads_of(const Threads& all) const {
    return (field_ || metric_) && !is_concurrent_ ? all.at_most(1) : all;
  }
  /// By region, what the user allows there besides a function; infinite without a limit.
  [[nodiscard]] const std::vector<double>& limits_of_regions() const { return of_region_; }
  /// By region, the most that a tetrahedron of the mesh may measure, infinite without a bound; none where no
  /// region has one.
  [[nodiscard]] const std::vector<double>& most_volumes() const { return most_volumes_; }
  [[nodiscard]] double gradation() const { return gradation_; }
  /// How far the surface's own sizes jump from vertex to vertex: 0 where they hardly do, as on surfaces of
  /// good triangles, to 1. It is 0 where sizes are given at vertices, or with a metric.
  [[nodiscard]] double steepness() const { return steepness_; }
  /// What the facets near a point need, where that is more than the size wanted there.
  [[nodiscard]] const FacetSizes& of_facets() const { return of_facets_; }
  /// Who decides on a size at a point in a region.
  [[nodiscard]] FacetSizes::By decider(double size, RegionId region) const {
    return field_ || !(size < of_region_[region]) ? FacetSizes::By::user : FacetSizes::By::surface;
  }
  /// Whether the user gave sizes at vertices of the surface, which may be far below its triangles.
  [[nodiscard]] bool is_given_at_vertices() const { return is_given_at_vertices_; }
  /// Inside, sizes do not grow beyond those of the surface round it.
  [[nodiscard]] bool grows() const { return grows_; }

 private:
  [[nodiscard]] bool heeds_facets() const { return !metric_ && most_volumes_.empty(); }
  [[nodiscard]] FacetSizes sizes_of_facets(const Complex& complex, const Threads& threads) const;
  void limit_regions(const Sizes& sizes, std::span<const RegionSeed> seeds, const Kept& kept);
  [[nodiscard]] Point unscaled(const Point& p) const;
  [[nodiscard]] double scaled(double h) const;
  [[nodiscard]] double field_at(const Point& p) const;

  double gradation_, steepness_ = 0;
  bool grows_, is_given_at_vertices_;
  int scale_;
  std::vector<double> of_region_;
  bool has_limit_of_region_ = false;      // asked for at each tetrahedron, and there may be 100,000 regions
  std::vector<double> factor_of_region_;  // that of_region_ is multiplied by already; none if by nothing
  std::vector<double> most_volumes_;
  std::function<double(const Point&)> field_;
  std::function<void(std::span<const Point>, std::span<double>)> fields_;
  std::function<Metric(const Point&)> metric_;
  bool is_concurrent_;
  std::vector<double> of_vertex_;
  double part_of_most_need_ = 1;
  FacetSizes of_facets_;
};

}  // namespace holdfast
