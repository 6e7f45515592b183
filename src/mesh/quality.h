// Quality of tetrahedra as the paper's §8 measures it. For reports: it decides nothing.
//
// Thin elements are what a report is about, so lengths, areas and volumes are right to a few digits however
// much their terms cancel: where floating point cannot tell, exact differences and products do.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "holdfast/holdfast.h"
#include "mesh/parallel.h"

namespace holdfast {

/// Q = sqrt(6)/12 * longest edge / inradius: 1 for a regular tetrahedron, infinite for a flat one, such as
/// one whose distinct exact corners share a double.
[[nodiscard]] double quality(const Point& a, const Point& b, const Point& c, const Point& d);

/// The six dihedral angles in degrees, at the edges ab, ac, ad, bc, bd, cd of a tetrahedron that is positive
/// or flat; NaN at the sides of a face without area.
[[nodiscard]] std::array<double, 6> dihedral_angles(const Point& a, const Point& b, const Point& c,
                                                    const Point& d);

/// Q and the cosines of the six dihedral angles in plain arithmetic, right to some nine digits; nothing for a
/// tetrahedron so thin, or so large or small, that they may not be. For going through whole volumes.
struct PlainShape {
  double quality = 0;
  std::array<double, 6> cosines{};
};
[[nodiscard]] std::optional<PlainShape> plain_shape(const Point& a, const Point& b, const Point& c,
                                                    const Point& d);

/// In which bin of so many degrees an angle lies, by its cosine; the last bin has all larger angles, too.
template <std::size_t kBins>
class CosineBins {
 public:
  explicit CosineBins(double degrees);
  /// The bin of an angle from 0 to 180 degrees.
  [[nodiscard]] std::size_t operator()(double cosine) const {
    const double cell = std::clamp((1 - cosine) * (kCells / 2.0), 0.0, kCells - 1.0);
    std::size_t bin = first_[static_cast<std::size_t>(cell)];
    while (bin + 1 < kBins && cosine <= end_[bin]) ++bin;
    return bin;
  }

 private:
  static constexpr std::size_t kCells = 512;
  std::array<double, kBins - 1> end_{};       // of each bin, its cosine
  std::array<std::uint8_t, kCells> first_{};  // bin that may hold cosines of a cell
};

/// Gathers the shapes of elements.
class ShapeHistogram {
 public:
  void add(const PlainShape& element);
  void add(const Point& a, const Point& b, const Point& c, const Point& d);
  void add(const ShapeHistogram& other);
  [[nodiscard]] const Report::Shape& shape() const { return shape_; }

 private:
  Report::Shape shape_;
  CosineBins<std::tuple_size_v<decltype(Report::Shape::least_dihedral)>> bins_{5};
  double of_least_ = -1, of_most_ = 1;  // cosines
};

/// The least Q of all tetrahedra that have abc as a face: the best that a mesh can have there. Infinite for
/// a triangle without area. (The paper's Target is the largest of them: the worst triangle's.)
[[nodiscard]] double best_quality_on(const Point& a, const Point& b, const Point& c);

/// The Target of the paper: the best Q of the triangle where that is worst. Zero for none.
[[nodiscard]] double target_quality(std::span<const Point> vertices, std::span<const Triangle> facets,
                                    const Threads& threads = 1);

/// Worst quality and dihedral angles of a volume, and the target that was found for its facets. An angle that
/// is not a number counts as 0 degrees. All zero for a volume without tetrahedra, but for the target.
/// `shape`, where given, receives the shapes of the elements.
[[nodiscard]] Report::Elements measure(const Volume& volume, double target, Report::Shape* shape = nullptr,
                                       const Threads& threads = 1);

}  // namespace holdfast
