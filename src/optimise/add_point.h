// A point for a bad element that nothing else helps, such as one on two facets that are almost one plane.
#pragma once

#include <span>

#include "mesh/edge_removal.h"
#include "optimise/star.h"
#include "optimise/volume.h"
#include "refine/point_cavity.h"

namespace holdfast {

class PointAdder {
 public:
  explicit PointAdder(ImprovedVolume& volume) : volume_(volume), cavity_(volume.mesh(), volume.seed()) {}

  /// Fills the shell of an edge of t anew from a point near its middle, if the energy is less then; a patient
  /// search tries the cavity that the in-sphere test gives such a point, too. Returns whether there is a new
  /// point. The new tetrahedra are its ball, in ball().
  bool add(Tet t, bool patient);
  [[nodiscard]] std::span<const Tet> ball() const { return cavity_.created(); }
  /// From now on, whether points must make the shares of elements with small angles less, too: energies fall
  /// the most where one hopeless element becomes several bad ones.
  void must_pay(bool must) { must_pay_ = must; }
  /// Of the last call, in tetrahedra looked at.
  [[nodiscard]] double work() const { return work_; }

 private:
  [[nodiscard]] Point middle_of_shell() const;
  bool add_at(const Point& place, Tet t, std::span<const Tet> tets);
  [[nodiscard]] bool find_cavity(Vertex p, Tet t, std::span<const Tet> tets);
  [[nodiscard]] bool improves(Vertex p);
  [[nodiscard]] bool is_allowed(Vertex p);
  [[nodiscard]] bool pays(Vertex p) const;
  [[nodiscard]] double energy_of_ball(Vertex p) const;

  ImprovedVolume& volume_;
  PointCavity cavity_;
  EdgeShell shell_;
  Frame frame_;
  Star star_;  // in the frame
  bool must_pay_ = false;
  double work_ = 0;
};

}  // namespace holdfast
