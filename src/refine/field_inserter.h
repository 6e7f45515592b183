// Inserts one field point where it keeps its distance from all others.
//
// The nearest vertex that a point sees is always one of those that it would be joined to, so that the mesh
// itself is the spatial index: for distances, and for the size, or metric, that is wanted at the point.
#pragma once

#include <span>
#include <vector>

#include "mesh/monitor.h"
#include "refine/point_cavity.h"
#include "refine/tuning.h"
#include "refine/volume_data.h"
#include "size/size_function.h"

namespace holdfast {

class FieldInserter {
 public:
  /// In a part, points keep away from interfaces that spheres beyond may reach across.
  FieldInserter(const VolumeData& volume, const SizeFunction& sizes, Monitor& monitor)
      : volume_(volume),
        mesh_(volume.mesh),
        sizes_(sizes),
        cavity_(volume.mesh, volume.seed, [&monitor] { monitor.poll_again(); }) {}

  /// Inserts a point at x, in the region of `start` and not far from it, unless it would be too near to a
  /// vertex or a facet. Returns the tetrahedra round it, none if it was not inserted.
  std::span<const Tet> insert(const Point& x, Tet start);
  /// The faces opposite the point inserted last.
  [[nodiscard]] std::span<const RimFace> rim() const { return cavity_.rim(); }
  /// Between vertices with thousands of neighbours each attempt examines thousands of tetrahedra, and nearly
  /// all attempts fail. Elsewhere about ten tetrahedra are examined in vain for each that is made.
  [[nodiscard]] bool has_wasted_enough() const {
    return wasted_ > tuning::kPatience * mesh_.tet_count() + tuning::kLeastPatience;
  }

 private:
  [[nodiscard]] bool fits(Vertex p, Tet start);
  [[nodiscard]] bool is_near_an_interface(Vertex p) const;
  std::span<const Vertex> vertices_round(Tet t);
  bool is_far_from(Vertex p, std::span<const Vertex> vertices, RegionId region);
  double want_metric(Vertex p, std::span<const Vertex> vertices);
  [[nodiscard]] bool is_near_beyond(Vertex p) const;
  [[nodiscard]] bool is_near_a_facet(Vertex p) const;

  const VolumeData volume_;
  TetMesh& mesh_;
  const SizeFunction& sizes_;
  PointCavity cavity_;
  std::array<Vertex, 8> round_{};
  double size_ = 0;                           // at the point
  double asked_ = 0;                          // the same without the effect of facets
  FacetSizes::By by_ = FacetSizes::By::user;  // what determines it
  double wanted_ = 0;                         // the same in the frame there
  Metric metric_{};                           // at the point, if there are metrics
  Frame frame_;
  std::size_t wasted_ = 0;  // tetrahedra of cavities that were not filled
};

}  // namespace holdfast
