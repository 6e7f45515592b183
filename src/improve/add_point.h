// A point for a bad element that nothing else helps, such as one on two facets that are almost one plane.
#pragma once

#include <vector>

#include "improve/smooth.h"
#include "improve/volume.h"
#include "mesh/edge_removal.h"
#include "refine/point_cavity.h"

namespace holdfast {

class PointAdder {
 public:
  PointAdder(ImprovedVolume& volume, VertexSmoother& smoother)
      : volume_(volume), smoother_(smoother), cavity_(volume.mesh()) {}

  /// Fills the shell of an edge of t anew from a point in its middle, if the energy is less then; a patient
  /// search tries the cavity that the in-sphere test gives such a point, too. Returns the point, or kNone.
  /// The new tetrahedra are its ball, in ball(). Where nothing is added, t may have moved to another slot,
  /// and is set to that.
  Vertex add(Tet& t, bool patient);
  [[nodiscard]] const std::vector<Tet>& ball() const { return ball_; }
  /// Of the last call, in tetrahedra looked at.
  [[nodiscard]] double work() const { return work_; }

 private:
  void take_back(const TetMesh::Corners& bad);
  [[nodiscard]] Point middle_of_shell() const;
  Vertex add_at(const Point& place, std::span<const Tet> tets);

  ImprovedVolume& volume_;
  VertexSmoother& smoother_;
  PointCavity cavity_;
  EdgeShell shell_;
  std::vector<TetMesh::Corners> old_;
  Tet tet_ = kNone;  // the bad element, wherever it is
  std::vector<Tet> ball_;
  double work_ = 0;
};

}  // namespace holdfast
