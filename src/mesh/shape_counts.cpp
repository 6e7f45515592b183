#include "mesh/shape_counts.h"

#include <cmath>
#include <mutex>
#include <numbers>

#include "numbers/elementary.h"

namespace holdfast {
namespace {

double degrees_of(double cosine) {
  return numbers::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
}

// Gathers the angles of a volume, as cosines where these are accurate enough, which is nearly everywhere.
class AngleHistogram {
 public:
  using Counts = decltype(VolumeShape::dihedrals);

  AngleHistogram() {
    for (std::size_t k = 0; k < kBins; ++k) {
      const double angle = std::numbers::pi * static_cast<double>(k) / kBins;
      start_[k] = {numbers::sin(angle), 2 * k == kBins ? 0 : numbers::cos(angle)};
    }
  }
  void add_cosine(double cosine) {
    greatest_cosine_ = std::max(greatest_cosine_, cosine);
    least_cosine_ = std::min(least_cosine_, cosine);
    ++counts_[bins_(cosine)];
  }
  void add(Angle angle) {
    if (!angle.is_known()) angle = {0, 1};
    if (angle < least_) least_ = angle;
    if (most_ < angle) most_ = angle;
    const auto after = std::upper_bound(start_.begin() + 1, start_.end(), angle);
    ++counts_[static_cast<std::size_t>(after - start_.begin()) - 1];
  }
  void add(const AngleHistogram& other) {
    for (std::size_t k = 0; k < kBins; ++k) counts_[k] += other.counts_[k];
    greatest_cosine_ = std::max(greatest_cosine_, other.greatest_cosine_);
    least_cosine_ = std::min(least_cosine_, other.least_cosine_);
    if (other.least_ < least_) least_ = other.least_;
    if (most_ < other.most_) most_ = other.most_;
  }
  [[nodiscard]] const Counts& counts() const { return counts_; }
  [[nodiscard]] double least_degrees() const {
    return std::min(least_.degrees(), degrees_of(greatest_cosine_));
  }
  [[nodiscard]] double most_degrees() const { return std::max(most_.degrees(), degrees_of(least_cosine_)); }

 private:
  static constexpr std::size_t kBins = std::tuple_size_v<Counts>;

  std::array<Angle, kBins> start_;  // of each bin
  CosineBins<kBins> bins_{180.0 / kBins};
  Counts counts_{};
  double greatest_cosine_ = -1, least_cosine_ = 1;
  Angle least_{0, -1}, most_{0, 1};
};

// Figures of some elements of a volume.
struct Measured {
  double worst = 0;
  AngleHistogram angles;
  ShapeHistogram shapes;

  void add(const Point& a, const Point& b, const Point& c, const Point& d) {
    PlainShape element;
    if (const auto plain = plain_shape(a, b, c, d)) {
      element = *plain;
      for (const double cosine : element.cosines) angles.add_cosine(cosine);
    } else {
      const CarefulShape careful = careful_shape(a, b, c, d);
      element = careful.plain();
      for (const Angle& angle : careful.angles) angles.add(angle);
    }
    worst = std::max(worst, element.quality);
    shapes.add(element);
  }
  void add(const Measured& other) {
    worst = std::max(worst, other.worst);
    angles.add(other.angles);
    shapes.add(other.shapes);
  }
};

}  // namespace

template <std::size_t kBins>
CosineBins<kBins>::CosineBins(double degrees) {
  for (std::size_t k = 0; k < end_.size(); ++k) {
    const double end = degrees * static_cast<double>(k + 1);
    end_[k] = end == 90 ? 0 : numbers::cos(end * std::numbers::pi / 180);
  }
  // Starts from a cosine half a cell before, which no rounding moves into the cell.
  for (std::size_t cell = 0; cell < kCells; ++cell) {
    const double before = 1 - (static_cast<double>(cell) - 0.5) * (2.0 / kCells);
    first_[cell] = static_cast<std::uint8_t>(
        std::count_if(end_.begin(), end_.end(), [&](double end) { return before <= end; }));
  }
}
template class CosineBins<std::tuple_size_v<decltype(ShapeCounts::least_dihedral)>>;
template class CosineBins<std::tuple_size_v<decltype(VolumeShape::dihedrals)>>;

void ShapeHistogram::add(const PlainShape& element) {
  double of_least = -1, of_most = 1;
  for (const double cosine : element.cosines) {
    of_least = std::max(of_least, cosine);
    of_most = std::min(of_most, cosine);
  }
  if (of_least > of_least_) {
    of_least_ = of_least;
    counts_.min_dihedral_deg = degrees_of(of_least_);
  }
  if (of_most < of_most_) {
    of_most_ = of_most;
    counts_.max_dihedral_deg = degrees_of(of_most_);
  }
  std::size_t q = 0;
  for (const double end : kQualityBins) q += element.quality < end ? 0 : 1;
  ++counts_.least_dihedral[bins_(of_least)];
  ++counts_.quality[q];
}

void ShapeHistogram::add(const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto plain = plain_shape(a, b, c, d);
  add(plain ? *plain : careful_shape(a, b, c, d).plain());
}

void ShapeHistogram::add(const ShapeHistogram& other) {
  for (std::size_t k = 0; k < counts_.least_dihedral.size(); ++k)
    counts_.least_dihedral[k] += other.counts_.least_dihedral[k];
  for (std::size_t k = 0; k < counts_.quality.size(); ++k) counts_.quality[k] += other.counts_.quality[k];
  if (other.of_least_ > of_least_) {
    of_least_ = other.of_least_;
    counts_.min_dihedral_deg = other.counts_.min_dihedral_deg;
  }
  if (other.of_most_ < of_most_) {
    of_most_ = other.of_most_;
    counts_.max_dihedral_deg = other.counts_.max_dihedral_deg;
  }
}

VolumeShape measure(const Volume& volume, const Threads& threads) {
  const std::vector<Point>& v = volume.vertices;
  Measured all;
  std::mutex mutex;
  parallel_ranges(threads, volume.tetrahedra.size(), [&](std::size_t first, std::size_t last) {
    Measured own;
    for (std::size_t k = first; k < last; ++k) {
      const Tetrahedron& t = volume.tetrahedra[k];
      own.add(v[t[0]], v[t[1]], v[t[2]], v[t[3]]);
    }
    const std::scoped_lock lock(mutex);
    all.add(own);
  });
  VolumeShape shape;
  if (volume.tetrahedra.empty()) return shape;
  shape.worst = all.worst;
  shape.dihedrals = all.angles.counts();
  shape.min_dihedral_deg = all.angles.least_degrees();
  shape.max_dihedral_deg = all.angles.most_degrees();
  shape.elements = all.shapes.counts();
  return shape;
}

}  // namespace holdfast
