// Surface layer: vertices that lie almost on other vertices or sides. A hint for people; it never decides
// validity.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "surface/complex.h"

namespace holdfast {

/// How near two things are, with the place on the second.
struct Nearness {
  Index vertex;
  Segment other;  ///< a side, or one vertex twice
  double distance;
};

class GapFinder {
 public:
  /// `table` is of the complex's facets and segments with their vertices identified.
  GapFinder(const Complex& complex, const SegmentTable& table);

  /// For each vertex of an open border the nearest vertex or side of one, if that is close. A side of a facet
  /// that has the vertex does not count: that is what needles are like.
  [[nodiscard]] std::vector<Nearness> between_borders() const;
  /// The closest two of these vertices, if they are close; the lesser index first.
  [[nodiscard]] std::optional<Nearness> among(std::span<const Index> vertices) const;

 private:
  /// The vertex's reach, by the shortest edge at it; 0 for what has none.
  [[nodiscard]] double reach(Index v) const { return reach_[v]; }
  [[nodiscard]] std::optional<Nearness> between(Index v, Index side) const;

  const Complex& complex_;
  const SegmentTable& table_;
  std::vector<double> reach_;
};

}  // namespace holdfast
