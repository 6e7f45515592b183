#include "io/dxf_spline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "numbers/elementary.h"
#include "numbers/vector.h"

namespace holdfast::io {

std::optional<DxfSpline> DxfSpline::read(DxfText& text, const DxfEntity& entity) {
  constexpr std::int64_t kMostDegree = 25;
  DxfSpline spline;
  std::vector<double> weights;
  for (const DxfGroup& group : entity.groups) {
    const auto in_last = [&](std::size_t k) {
      if (!spline.controls_.empty()) spline.controls_.back()[k] = text.real(group);
    };
    if (group.code == 40) spline.knots_.push_back(text.real(group));
    if (group.code == 41) weights.push_back(text.real(group));
    if (group.code == 10) spline.controls_.push_back({text.real(group), 0, 0, 1});
    if (group.code == 20) in_last(1);
    if (group.code == 30) in_last(2);
  }
  if (spline.controls_.empty()) return std::nullopt;
  const std::int64_t degree = text.integer(entity, 71, 3);
  const std::size_t count = spline.controls_.size();
  if (degree < 1 || degree > kMostDegree || count <= static_cast<std::size_t>(degree))
    text.fail_at(entity.place, "a spline of degree " + std::to_string(degree) + " with " +
                                   std::to_string(count) + " control points");
  spline.degree_ = static_cast<std::size_t>(degree);
  if (const std::string fault = spline.fault_with(weights); !fault.empty())
    text.fail_at(entity.place, "a spline " + fault);
  spline.weigh(weights);
  return spline;
}

std::string DxfSpline::fault_with(std::span<const double> weights) const {
  const auto are_finite = [](std::span<const double> numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
  };
  const std::size_t count = controls_.size(), needed = count + degree_ + 1;
  if (!std::all_of(controls_.begin(), controls_.end(), are_finite) || !are_finite(knots_) ||
      !are_finite(weights))
    return "whose numbers are not finite";
  if (knots_.size() != needed)
    return "with " + std::to_string(knots_.size()) + " knots, where its control points need " +
           std::to_string(needed);
  if (!std::is_sorted(knots_.begin(), knots_.end()) || !(knots_[degree_] < knots_[count]))
    return "whose knots do not increase";
  if (!weights.empty() && weights.size() != count) return "with more or fewer weights than control points";
  if (std::any_of(weights.begin(), weights.end(), [](double w) { return !(w > 0); }))
    return "with a weight that is not positive";
  return {};
}

void DxfSpline::weigh(std::span<const double> weights) {
  for (const Homogeneous& control : controls_)
    for (std::size_t k = 0; k < 3; ++k) magnitude_ = std::max(magnitude_, std::fabs(control[k]));
  for (std::size_t i = 0; i < weights.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) controls_[i][k] *= weights[i];
    controls_[i][3] = weights[i];
  }
}

std::vector<Point> DxfSpline::points(double degrees) const {
  constexpr int kMostDepth = 12;  // at a cusp; 4,096 pieces of 0.1 degrees turn once
  std::vector<Point> points{at(knots_[degree_])};
  for (std::size_t k = degree_; k < controls_.size(); ++k)
    if (knots_[k] < knots_[k + 1]) add_between(knots_[k], knots_[k + 1], degrees, kMostDepth, points);
  return points;
}

void DxfSpline::add_between(double from, double to, double degrees, int depth,
                            std::vector<Point>& points) const {
  const double middle = from + (to - from) / 2;
  if (depth > 0 && from < middle && middle < to && turn(from, to) > degrees) {
    add_between(from, middle, degrees, depth - 1, points);
    add_between(middle, to, degrees, depth - 1, points);
  } else if (const Point end = at(to); end != points.back()) {
    points.push_back(end);
  }
}

// De Boor's algorithm. At a knot of full multiplicity, as at the ends, it returns the control point bit for
// bit.
Point DxfSpline::at(double parameter) const {
  const auto inner = knots_.begin() + static_cast<std::ptrdiff_t>(degree_);
  const auto last = knots_.begin() + static_cast<std::ptrdiff_t>(controls_.size());
  auto above = std::upper_bound(inner, last, parameter);
  if (above == last) above = std::lower_bound(inner, last, *last);  // the last span that is not empty
  const auto span = static_cast<std::size_t>(above - knots_.begin()) - 1;
  std::vector<Homogeneous> d(controls_.begin() + static_cast<std::ptrdiff_t>(span - degree_),
                             controls_.begin() + static_cast<std::ptrdiff_t>(span + 1));
  for (std::size_t r = 1; r <= degree_; ++r)
    for (std::size_t j = degree_; j >= r; --j) {
      const double low = knots_[j + span - degree_], high = knots_[j + 1 + span - r];
      const double share = (parameter - low) / (high - low);
      for (std::size_t k = 0; k < 4; ++k) d[j][k] = (1 - share) * d[j - 1][k] + share * d[j][k];
    }
  const Homogeneous& p = d[degree_];
  if (p[3] == 1) return {p[0], p[1], p[2]};
  return {p[0] / p[3], p[1] / p[3], p[2] / p[3]};
}

/// The sum of the angles between chords, which lacks half of one at both ends. What is no longer than
/// rounding does not turn.
double DxfSpline::turn(double from, double to) const {
  constexpr std::size_t kChords = 8;
  std::array<Vector, kChords> chords{};
  Point before = at(from);
  double whole = 0;
  for (std::size_t k = 0; k < kChords; ++k) {
    const double share = static_cast<double>(k + 1) / kChords;
    const Point next = at(k + 1 == kChords ? to : from + share * (to - from));
    chords[k] = next - before;
    whole += length(chords[k]);
    before = next;
  }
  constexpr double kRounding = 1e-12;  // of the largest coordinate
  if (whole <= kRounding * magnitude_) return 0;
  double sum = 0;
  for (std::size_t k = 1; k < kChords; ++k)
    sum += numbers::atan2(length(cross(chords[k - 1], chords[k])), dot(chords[k - 1], chords[k]));
  return sum * kChords / (kChords - 1) * 180 / std::numbers::pi;
}

}  // namespace holdfast::io
