// How many elements of a volume have which shape: Q and dihedral angles (quality.h) in bins.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "holdfast/types.h"
#include "mesh/parallel.h"
#include "mesh/quality.h"

namespace holdfast {

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
  static constexpr std::size_t kCells = 512;  // of cosines; most of them lie in one bin
  std::array<double, kBins - 1> end_{};       // of each bin, its cosine
  std::array<std::uint8_t, kCells> first_{};  // bin that may hold cosines of a cell
};

/// Where bins of Q end; the last has no end.
inline constexpr std::array<double, 9> kQualityBins{1.25, 1.5, 2, 3, 5, 10, 30, 100, 1000};

struct ShapeCounts {
  double min_dihedral_deg = 0, max_dihedral_deg = 0;
  std::array<std::size_t, 15> least_dihedral{};  ///< elements by their least angle, in bins of 5 degrees
  std::array<std::size_t, kQualityBins.size() + 1> quality{};
};

/// Gathers the shapes of elements.
class ShapeHistogram {
 public:
  void add(const PlainShape& element);
  void add(const Point& a, const Point& b, const Point& c, const Point& d);
  void add(const ShapeHistogram& other);
  [[nodiscard]] const ShapeCounts& counts() const { return counts_; }

 private:
  ShapeCounts counts_;
  CosineBins<std::tuple_size_v<decltype(ShapeCounts::least_dihedral)>> bins_{5};
  double of_least_ = -1, of_most_ = 1;  // cosines
};

/// Of the elements of a volume. An angle that is not a number counts as 0 degrees. All zero for a volume
/// without tetrahedra.
struct VolumeShape {
  double worst = 0;  ///< Q
  double min_dihedral_deg = 0, max_dihedral_deg = 0;
  std::array<std::size_t, 18> dihedrals{};  ///< all angles, in bins of 10 degrees
  ShapeCounts elements;
};
[[nodiscard]] VolumeShape measure(const Volume& volume, const Threads& threads = 1);

}  // namespace holdfast
