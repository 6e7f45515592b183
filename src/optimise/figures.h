// The figures by which meshes of one volume are compared: more effort, and field points, must make none of
// them worse. They are the least dihedral angle, the share of elements with an angle below 10 degrees, and
// the mean Q.
#pragma once

#include <array>
#include <cstddef>

#include "mesh/parallel.h"
#include "mesh/quality.h"
#include "refine/volume_data.h"

namespace holdfast {

/// The figures of some elements of a volume. Their bits do not depend on the number of threads.
class Figures {
 public:
  void add(const Point& a, const Point& b, const Point& c, const Point& d);
  void add(const Figures& others);

  [[nodiscard]] const Angle& least() const { return least_; }
  [[nodiscard]] std::size_t elements() const { return elements_; }
  [[nodiscard]] std::size_t below_10_deg() const { return below_; }
  [[nodiscard]] std::size_t below_30_deg() const { return below_30_; }
  [[nodiscard]] double worst_quality() const { return worst_; }
  [[nodiscard]] double mean_quality() const { return sums_[0] / static_cast<double>(elements_); }
  /// The same, where flat elements count for less.
  [[nodiscard]] double tempered_quality() const { return sums_[1] / static_cast<double>(elements_); }
  /// Whether none of the three is worse.
  [[nodiscard]] bool is_no_worse_than(const Figures& other) const;

 private:
  friend class Standard;
  // One flat element can dominate a mean of Q. So there are two means; the second caps Q lower, so that the
  // other elements count, too.
  static constexpr std::array<double, 2> kMostQuality{1e15, 1e6};

  std::size_t elements_ = 0, below_ = 0, below_30_ = 0;
  Angle least_{0, -1};
  double worst_ = 0;
  std::array<double, 2> sums_{};
};

/// Of the tetrahedra of the kept regions, as they are in space.
[[nodiscard]] Figures figures_of(const VolumeData& volume, const Threads& threads = 1);
[[nodiscard]] Figures figures_of(const TetMesh& mesh, const std::vector<Tet>& tets,
                                 const Threads& threads = 1);

/// Figures that changes of a mesh have to keep, starting from a mesh that has them.
class Standard {
 public:
  explicit Standard(const Figures& kept) : kept_(kept), now_(kept) {}

  /// Whether the figures are kept when `fresh` replace `old`. If so, the replacement is recorded.
  [[nodiscard]] bool allows(const Figures& old, const Figures& fresh);

 private:
  Figures kept_, now_;
};

}  // namespace holdfast
