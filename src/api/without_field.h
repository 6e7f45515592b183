// The mesh without field points, as --fill makes it: the standard that a mesh with field points must reach if
// the surface decides on the number of elements.
#pragma once

#include <optional>

#include "api/boundary.h"
#include "optimise/figures.h"

namespace holdfast {

class WithoutField {
 public:
  /// Whether the user leaves sizes to the surface, or limits them for whole regions only, so that a
  /// comparison may be useful.
  [[nodiscard]] static bool is_asked_for(const Options& options);
  /// Copies the mesh, which has no field points yet, unless it is very large or the limits ask for many more
  /// elements than it has.
  WithoutField(const Attempt& attempt, const BoxMesh& box, const Division& division,
               double elements_asked_for);

  /// Whether there is a mesh to compare with.
  [[nodiscard]] bool is_given() const { return before_.elements() > 0; }
  /// Known even without a mesh to compare with, unless it is very large or hardly matters.
  [[nodiscard]] std::size_t elements() const { return elements_; }
  /// The number of regular elements of the requested sizes.
  [[nodiscard]] double elements_asked_for() const { return asked_for_; }
  /// The part of these that must be left when points that do not pay are removed: all, unless it was set.
  [[nodiscard]] double elements_to_be_left() const { return to_be_left_; }
  void leave(double elements) { to_be_left_ = elements; }
  /// Whether some figure of the mesh with field points is worse than this mesh's. The first call optimises
  /// this mesh, unless its figures are certain to stay worse.
  [[nodiscard]] bool is_better_somewhere(const Figures& with_field);
  /// Whether more work may repair the figures of a mesh with field points that are worse.
  [[nodiscard]] bool is_within_reach(const Figures& with_field) const;
  /// Of the optimised mesh; 0 without one.
  [[nodiscard]] double worst_quality() const { return optimised_ ? optimised_->worst_quality() : 0; }
  /// Replaces the mesh with field points by the optimised one.
  void take(BoxMesh& box, Division& division);

 private:
  const Attempt& attempt_;
  TetMesh mesh_;
  Division division_;
  Vertex first_free_ = 0;
  double asked_for_, to_be_left_;
  std::size_t elements_ = 0;
  Figures before_;                    // before the optimisation
  std::optional<Figures> optimised_;  // after the optimisation
};

}  // namespace holdfast
