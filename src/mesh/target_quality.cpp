#include "mesh/target_quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "mesh/careful.h"
#include "mesh/quality.h"
#include "numbers/elementary.h"

namespace holdfast {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The tetrahedra on a triangle abc that compete for the least Q.
//
// Let L be the longest side. Over a given foot the inradius grows with the height h of the apex p: r = A h /
// (A + sum of l_i sqrt(d_i^2 + h^2) / 2), with A the area, l_i the sides and d_i the distances of the foot
// from them. So p lies as high as the longest edge allows, and a longest edge above L never pays. Hence p
// lies on a sphere of radius L round a corner. The best p lies on two of them, round the ends of the longest
// side, so that p makes an equilateral triangle with this side. One number remains: the angle between that
// triangle and abc. (That the best p is of this kind was found by a search over all p; the unit test repeats
// it.)
class BestTetrahedron {
 public:
  BestTetrahedron(const Point& a, const Point& b, const Point& c) {
    std::array<double, 3> side{length(c - b), length(a - c), length(b - a)};
    std::sort(side.begin(), side.end());
    longest_ = side[2];
    twice_area_ = length(careful::normal(a, b, c));
    // The third corner beside the longest side: its height over it, and the part that it cuts off.
    height_ = twice_area_ / longest_;
    along_ = std::sqrt(std::max(0.0, side[1] * side[1] - height_ * height_));
  }

  [[nodiscard]] bool flat() const { return !(twice_area_ > 0); }

  // Q with the apex at this angle, in coordinates where the longest side is the x-axis.
  [[nodiscard]] double at(double angle) const {
    const double l = longest_;
    const double reach = l * std::numbers::sqrt3 / 2;
    const Vector apex{l / 2, reach * numbers::cos(angle), reach * numbers::sin(angle)};
    const double twice_lateral = l * reach + twice_area({along_, height_, 0}, apex) +
                                 twice_area({along_ - l, height_, 0}, {-l / 2, apex[1], apex[2]});
    const Vector to_third{along_ - apex[0], height_ - apex[1], apex[2]};
    const double longest = std::max(l, length(to_third));
    return kInradiusOfRegular * longest * (twice_area_ + twice_lateral) / (twice_area_ * apex[2]);
  }

  [[nodiscard]] double best_angle() const {
    constexpr double kGolden = 0.6180339887498949;  // (sqrt(5) - 1) / 2
    constexpr int kSteps = 60;                      // of a golden section search: 0.37 * kGolden^60 = 1e-13
    double low = 1.2;  // acos(1/3) = 1.231, of the equilateral triangle, is the least
    double high = std::numbers::pi / 2;
    double x = high - kGolden * (high - low), y = low + kGolden * (high - low);
    double at_x = at(x), at_y = at(y);
    for (int k = 0; k < kSteps; ++k) {
      if (at_x < at_y) {
        high = std::exchange(y, x);
        at_y = at_x;
        at_x = at(x = high - kGolden * (high - low));
      } else {
        low = std::exchange(x, y);
        at_x = at_y;
        at_y = at(y = low + kGolden * (high - low));
      }
    }
    return 0.5 * (low + high);
  }

 private:
  // Of the triangle 0 u v.
  static double twice_area(const Vector& u, const Vector& v) { return length(cross(u, v)); }

  double longest_, twice_area_, height_, along_;
};

double target_of(std::span<const Point> vertices, std::span<const Triangle> facets) {
  // Any candidate bounds the best one from above: the one for the worst triangle so far rules out most
  // triangles, and all of its shape.
  constexpr double kRounding = 1e-12;
  double target = 0, angle = 1.3;  // any angle will do for the first triangle
  for (const Triangle& f : facets) {
    const auto p = careful::brought_in_range<3>({vertices[f[0]], vertices[f[1]], vertices[f[2]]});
    const BestTetrahedron candidates(p[0], p[1], p[2]);
    if (candidates.flat()) return kInfinity;
    if (!(candidates.at(angle) > (1 + kRounding) * target)) continue;
    const double best = candidates.best_angle();
    if (!(candidates.at(best) > target)) continue;
    target = candidates.at(best);
    angle = best;
  }
  return target;
}

}  // namespace

double best_quality_on(const Point& a, const Point& b, const Point& c) {
  const auto p = careful::brought_in_range<3>({a, b, c});
  const BestTetrahedron candidates(p[0], p[1], p[2]);
  return candidates.flat() ? kInfinity : candidates.at(candidates.best_angle());
}

double target_quality(std::span<const Point> vertices, std::span<const Triangle> facets,
                      const Threads& threads) {
  // The same for any number of threads, because the last bits may depend on it.
  constexpr std::size_t kBlock = 8192;
  std::vector<double> targets(1 + facets.size() / kBlock);
  parallel(threads, targets.size(), [&](std::size_t k) {
    const std::size_t first = k * kBlock;
    targets[k] = target_of(vertices, facets.subspan(first, std::min(kBlock, facets.size() - first)));
  });
  return *std::max_element(targets.begin(), targets.end());
}

}  // namespace holdfast
