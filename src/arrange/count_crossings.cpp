// Crossings are computed in doubles, each with a bound on its error. Those that lie apart by more than that
// in one direction are different points.
#include "arrange/count_crossings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "exact/tiers.h"
#include "surface/aabb_tree.h"

namespace holdfast::arrange {
namespace {

using plane::Position;

constexpr double kEpsilon = exact::detail::kEpsilon;

class Counting {
 public:
  Counting(std::span<const Piece> pieces, std::span<const Position> points, std::size_t enough)
      : pieces_(pieces), points_(points), enough_(enough) {
    Position low = pieces[0][0], high = low;
    const auto take = [&](const Position& p) {
      for (std::size_t k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
        largest_ = std::max(largest_, std::fabs(p[k]));
      }
    };
    for (const Piece& piece : pieces) std::for_each(piece.begin(), piece.end(), take);
    std::for_each(points.begin(), points.end(), take);
    extent_ = std::max(high[0] - low[0], high[1] - low[1]);
    // Coordinates err by eps M, with M the largest, so differences, which are at most D, by 2 eps M + eps D.
    // A determinant errs by 4 D times that, and by 4 eps D^2 for its own roundings.
    bound_ = 16 * kEpsilon * extent_ * (largest_ + extent_);
  }

  std::size_t run() {
    constexpr double kLeast = 0x1p-300, kMost = 0x1p300;  // products neither overflow nor lose bits
    if (!(extent_ > kLeast && largest_ < kMost)) return 0;
    std::vector<Box> boxes;
    boxes.reserve(pieces_.size());
    for (const auto& [a, b] : pieces_) {
      const auto [left, right] = std::minmax(a[0], b[0]);
      const auto [bottom, top] = std::minmax(a[1], b[1]);
      boxes.push_back({{left, bottom, 0}, {right, top, 0}});
    }
    constexpr std::size_t kLooks = 64;  // for each crossing: as many take a tenth of the time to make it
    std::size_t looks = 0;
    // Where three planes meet in a point, each pair of their lines crosses there.
    std::size_t counted_next = enough_ + enough_ / 8;
    const auto are_enough = [&] {
      if (found_.size() < counted_next) return false;
      counted_next = 2 * found_.size();
      return apart() >= enough_;
    };
    AabbTree(boxes).for_each_overlap(
        [&](Index i, Index j) {
          cross(pieces_[i], pieces_[j]);
          return ++looks < kLooks * (pieces_.size() + found_.size()) && !are_enough();
        },
        [](Index, Index) { return false; }, [](double) {});
    return apart();
  }

 private:
  struct Range {
    double low, high;
  };

  /// Twice the area of a triangle.
  static double area(const Position& a, const Position& b, const Position& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
  /// Whether two ends lie certainly on different sides.
  [[nodiscard]] bool differ(double one, double other) const {
    return (one > bound_ && other < -bound_) || (one < -bound_ && other > bound_);
  }

  /// Notes where two pieces cross.
  void cross(const Piece& one, const Piece& other) {
    const auto& [a, b] = one;
    const auto& [c, d] = other;
    const double of_a = area(c, d, a), of_b = area(c, d, b);
    if (!differ(of_a, of_b) || !differ(area(a, b, c), area(a, b, d))) return;
    const double share = of_a / (of_a - of_b);
    const double error = 4 * bound_ / std::fabs(of_a - of_b);
    const Position along{b[0] - a[0], b[1] - a[1]};
    const double at = height({a[0] + share * along[0], a[1] + share * along[1]});
    found_.push_back(round(at, 2 * error * (std::fabs(along[0]) + std::fabs(along[1]))));
  }

  /// Along a direction that is hardly that of any rows and columns.
  static double height(const Position& p) { return 0.7548776662466927 * p[0] + 0.5698402909980532 * p[1]; }

  /// A height that errs by so much, and by rounding.
  [[nodiscard]] Range round(double at, double error) const {
    const double wide = error + 64 * kEpsilon * (largest_ + extent_);
    return {at - wide, at + wide};
  }

  /// The largest number of ranges of which no two meet, without those that meet a given point.
  std::size_t apart() {
    std::vector<double> given;
    given.reserve(points_.size());
    for (const Position& p : points_) given.push_back(height(p));
    std::sort(given.begin(), given.end());
    std::sort(found_.begin(), found_.end(),
              [](const Range& one, const Range& other) { return one.high < other.high; });
    const double wide = round(0, 0).high;
    double last = -std::numeric_limits<double>::infinity();
    std::size_t count = 0;
    for (const Range& range : found_) {
      if (!(range.low > last)) continue;
      const auto at = std::lower_bound(given.begin(), given.end(), range.low - wide);
      if (at != given.end() && *at <= range.high + wide) continue;
      last = range.high;
      ++count;
    }
    return count;
  }

  const std::span<const Piece> pieces_;
  const std::span<const Position> points_;
  const std::size_t enough_;
  double largest_ = 0, extent_ = 0, bound_ = 0;
  std::vector<Range> found_;
};

}  // namespace

std::size_t count_crossings(std::span<const Piece> pieces, std::span<const Position> points,
                            std::size_t enough) {
  return pieces.empty() ? 0 : Counting(pieces, points, enough).run();
}

}  // namespace holdfast::arrange
