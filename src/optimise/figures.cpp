#include "optimise/figures.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace holdfast {
namespace {

constexpr double kRounding = 1e-9;  // above that of the sums

// Above this, a cosine determines the small angle poorly.
constexpr double kGreatCosine = 0.98;

// An angle within 1e-6 degrees of 10 does not count as below: boxes and wedges make many angles of round
// numbers.
constexpr Angle kTenDegrees{0.17364816047879253, 0.9848077560429404};
// These are not compared, so they need no such care.
constexpr Angle kThirtyDegrees{0.5, 0.8660254037844386};

Angle least_of(const CarefulShape& shape) {
  Angle least{0, -1};
  for (const Angle& angle : shape.angles) {
    if (!angle.is_known()) return {0, 1};
    if (angle < least) least = angle;
  }
  return least;
}

struct Element {
  Angle least;
  double quality;
};

Element element_of(const Point& a, const Point& b, const Point& c, const Point& d) {
  if (const auto plain = plain_shape(a, b, c, d)) {
    const double cosine = *std::max_element(plain->cosines.begin(), plain->cosines.end());
    if (cosine < kGreatCosine) return {{std::sqrt((1 - cosine) * (1 + cosine)), cosine}, plain->quality};
  }
  const CarefulShape careful = careful_shape(a, b, c, d);
  return {least_of(careful), careful.quality};
}

// Sums over blocks of a fixed number of tetrahedra, so that rounding does not depend on the threads.
template <typename Add>
Figures gather(std::size_t count, const Threads& threads, Add&& add) {
  constexpr std::size_t kBlock = 16384;
  std::vector<Figures> blocks((count + kBlock - 1) / kBlock);
  parallel(threads, blocks.size(), [&](std::size_t k) {
    for (std::size_t i = k * kBlock; i < std::min(count, (k + 1) * kBlock); ++i) add(i, blocks[k]);
  });
  Figures all;
  for (const Figures& own : blocks) all.add(own);
  return all;
}

void add_tet(const TetMesh& mesh, Tet t, Figures& figures) {
  const TetMesh::Corners& c = mesh.corners(t);
  figures.add(mesh.position(c[0]), mesh.position(c[1]), mesh.position(c[2]), mesh.position(c[3]));
}

}  // namespace

void Figures::add(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Element element = element_of(a, b, c, d);
  ++elements_;
  if (element.least < kTenDegrees) ++below_;
  if (element.least < kThirtyDegrees) ++below_30_;
  if (element.least < least_) least_ = element.least;
  worst_ = std::max(worst_, element.quality);
  for (std::size_t k = 0; k < sums_.size(); ++k) sums_[k] += std::min(element.quality, kMostQuality[k]);
}

void Figures::add(const Figures& others) {
  elements_ += others.elements_;
  below_ += others.below_;
  below_30_ += others.below_30_;
  if (others.least_ < least_) least_ = others.least_;
  worst_ = std::max(worst_, others.worst_);
  for (std::size_t k = 0; k < sums_.size(); ++k) sums_[k] += others.sums_[k];
}

bool Figures::is_no_worse_than(const Figures& other) const {
  if (least_ < other.least_) return false;
  const auto count = static_cast<double>(elements_), of_other = static_cast<double>(other.elements_);
  if (static_cast<double>(below_) * of_other > static_cast<double>(other.below_) * count) return false;
  for (std::size_t k = 0; k < sums_.size(); ++k)
    if (sums_[k] * of_other > other.sums_[k] * count * (1 + kRounding)) return false;
  return true;
}

Figures figures_of(const VolumeData& volume, const Threads& threads) {
  return gather(volume.mesh.slot_count(), threads, [&](std::size_t k, Figures& own) {
    const auto t = static_cast<Tet>(k);
    if (volume.is_inside(t)) add_tet(volume.mesh, t, own);
  });
}

Figures figures_of(const TetMesh& mesh, const std::vector<Tet>& tets, const Threads& threads) {
  return gather(tets.size(), threads, [&](std::size_t k, Figures& own) { add_tet(mesh, tets[k], own); });
}

bool Standard::allows(const Figures& old, const Figures& fresh) {
  if (fresh.least_ < kept_.least_) return false;
  Figures next = now_;
  next.elements_ = now_.elements_ - old.elements_ + fresh.elements_;
  next.below_ = now_.below_ - old.below_ + fresh.below_;
  const auto count = static_cast<double>(next.elements_), of_now = static_cast<double>(now_.elements_),
             of_kept = static_cast<double>(kept_.elements_);
  if (static_cast<double>(next.below_) * of_kept > static_cast<double>(kept_.below_) * count) return false;
  for (std::size_t k = 0; k < next.sums_.size(); ++k) {
    next.sums_[k] = now_.sums_[k] - old.sums_[k] + fresh.sums_[k];
    const bool is_surely_kept = next.sums_[k] * of_kept < kept_.sums_[k] * count * (1 - kRounding);
    if (!is_surely_kept && next.sums_[k] * of_now > now_.sums_[k] * count) return false;
  }
  now_ = next;
  return true;
}

}  // namespace holdfast
