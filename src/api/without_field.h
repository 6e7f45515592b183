// What a mesh would be without field points, as --fill makes it: the least that field points have to be worth
// where it is the surface that decides on the number of elements.
#pragma once

#include <optional>

#include "api/boundary.h"
#include "optimise/figures.h"

namespace holdfast {

class WithoutField {
 public:
  /// Whether the user leaves sizes to the surface, or limits them for whole regions, so that there may be
  /// something to compare.
  [[nodiscard]] static bool is_asked_for(const Options& options);
  /// Copies the mesh, which has no field points yet. Nothing of a very large one, nor where the limits ask
  /// for many more elements than it has.
  WithoutField(const Attempt& attempt, const BoxMesh& box, const Division& division,
               double elements_asked_for);

  /// Whether there is anything to compare with.
  [[nodiscard]] bool is_given() const { return elements() > 0; }
  [[nodiscard]] std::size_t elements() const { return before_.elements(); }
  /// Regular ones as large as the limits are so many.
  [[nodiscard]] double elements_asked_for() const { return asked_for_; }
  /// Whether some figure of the mesh with field points is worse than of this one. The first call optimises
  /// this one, unless it is plain that nothing will be.
  [[nodiscard]] bool is_better_somewhere(const Figures& with_field);
  /// Whether more work on a mesh with field points, some figure of which is worse, may mend that.
  [[nodiscard]] bool is_within_reach(const Figures& with_field) const;
  /// Of the optimised one; 0 without.
  [[nodiscard]] double worst_quality() const { return optimised_ ? optimised_->worst_quality() : 0; }
  /// Puts it, optimised, in the place of the mesh with field points.
  void take(BoxMesh& box, Division& division);

 private:
  const Attempt& attempt_;
  TetMesh mesh_;
  Division division_;
  Vertex first_free_ = 0;
  double asked_for_;
  Figures before_;                    // the optimisation
  std::optional<Figures> optimised_;  // then
};

}  // namespace holdfast
