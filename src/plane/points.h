// The points of a triangulation in the plane: explicit (two doubles) or exact (rational), behind the same
// predicates.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "exact/incircle.h"
#include "exact/rational_point.h"
#include "mesh/large_array.h"

namespace holdfast::plane {

using Vertex = std::uint32_t;
inline constexpr Vertex kNoVertex = ~Vertex{0};
/// The coordinates of a point, or the doubles nearest to an exact one.
using Position = std::array<double, 2>;
using Positions = LargeVector<Position>;

class Points {
 public:
  Points() = default;
  explicit Points(std::span<const Position> positions) : positions_(positions.begin(), positions.end()) {}
  explicit Points(Positions&& positions) : positions_(std::move(positions)) {}
  Points(Points&&) = default;
  Points& operator=(Points&&) = default;

  [[nodiscard]] std::size_t size() const { return positions_.size(); }
  [[nodiscard]] const Position& operator[](Vertex v) const { return positions_[v]; }
  [[nodiscard]] const Positions& positions() const { return positions_; }

  [[nodiscard]] bool all_explicit() const { return exact_.empty(); }
  /// Prefetches the position of a point.
  void fetch(Vertex v) const { __builtin_prefetch(&positions_[v]); }

  Vertex add(const Position& p);
  Vertex add(exact::RationalPoint p);
  /// The same for callers that know the nearest doubles.
  Vertex add(exact::RationalPoint p, const Position& nearest);
  /// Adds a point of another set.
  Vertex add(const Points& others, Vertex v);
  /// Keeps only the first `count` points.
  void shrink(std::size_t count);
  [[nodiscard]] exact::RationalPoint rational(Vertex v) const;

  /// As exact::orient2d: +1 if abc turns left.
  [[nodiscard]] int orient(Vertex a, Vertex b, Vertex c) const {
    if (exact_.empty()) [[likely]]
      return exact::orient2d(at(a), at(b), at(c));
    return mixed_orient(a, b, c);
  }
  /// As exact::incircle: +1 if d lies inside the circle through the positive triangle abc.
  [[nodiscard]] int incircle(Vertex a, Vertex b, Vertex c, Vertex d) const {
    if (exact_.empty()) [[likely]]
      return exact::incircle(at(a), at(b), at(c), at(d));
    return mixed_incircle(a, b, c, d);
  }
  /// A cheap filter: true only if d lies inside the circle through the positive triangle abc; false is
  /// undecided.
  [[nodiscard]] bool surely_in_circle(Vertex a, Vertex b, Vertex c, Vertex d) const;
  /// Sign of a - b in lexicographic order; 0 for coincident points.
  [[nodiscard]] int compare(Vertex a, Vertex b) const {
    if (exact_.empty()) [[likely]]
      return compare_positions(a, b);
    return mixed_compare(a, b);
  }
  /// +1 if d lies further to the left of the line ab than c.
  [[nodiscard]] int compare_heights(Vertex a, Vertex b, Vertex c, Vertex d) const;
  /// Whether p, which lies on the line ab, lies strictly between a and b.
  [[nodiscard]] bool between(Vertex a, Vertex b, Vertex p) const {
    const int before = compare(a, p);
    return before != 0 && before == compare(p, b);
  }

 private:
  [[nodiscard]] const double* at(Vertex v) const { return positions_[v].data(); }
  [[nodiscard]] int compare_positions(Vertex a, Vertex b) const {
    const Position &p = positions_[a], &q = positions_[b];
    if (p[0] != q[0]) return p[0] < q[0] ? -1 : 1;
    if (p[1] != q[1]) return p[1] < q[1] ? -1 : 1;
    return 0;
  }
  [[nodiscard]] bool is_exact(Vertex v) const { return v < exact_.size() && exact_[v] != nullptr; }
  [[nodiscard]] int mixed_orient(Vertex a, Vertex b, Vertex c) const;
  [[nodiscard]] int fine_orient(Vertex a, Vertex b, Vertex c) const;
  [[nodiscard]] int mixed_incircle(Vertex a, Vertex b, Vertex c, Vertex d) const;
  [[nodiscard]] int mixed_compare(Vertex a, Vertex b) const;

  struct ExactPoint {
    exact::RationalPoint at;
    Position rest;  // the difference from its position, accurate to 2^-100 of that, or NaN
  };
  Vertex add(ExactPoint p, const Position& nearest);

  Positions positions_;
  // By vertex; null for explicit points, and not longer than up to the last exact one.
  std::vector<const ExactPoint*> exact_;
  std::deque<ExactPoint> store_;  // a deque, whose addresses are stable
};

}  // namespace holdfast::plane
