// Surface layer: vertices that lie almost on other vertices or sides. A hint for users; it never decides
// validity.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "surface/complex.h"

namespace holdfast {

/// How close a vertex is to another vertex or a side, and the nearest place on that.
struct Nearness {
  Index vertex;
  Segment other;  ///< a side, or one vertex twice
  double distance;
};

class GapFinder {
 public:
  /// `table` is that of the complex's facets and segments, with identical vertices identified.
  GapFinder(const Complex& complex, const SegmentTable& table);

  /// For each vertex of an open border, the nearest vertex or side of a border, if it is close. Sides of
  /// facets at the vertex do not count: they are close in every needle.
  [[nodiscard]] std::vector<Nearness> between_borders() const;
  /// The closest two of these vertices, if they are close; the lesser index comes first.
  [[nodiscard]] std::optional<Nearness> among(std::span<const Index> vertices) const;

 private:
  /// The vertex's reach, from the shortest edge at it; 0 for a vertex without edges.
  [[nodiscard]] double reach(Index v) const { return reach_[v]; }
  [[nodiscard]] std::optional<Nearness> between(Index v, Index side) const;

  const Complex& complex_;
  const SegmentTable& table_;
  std::vector<double> reach_;
};

}  // namespace holdfast
