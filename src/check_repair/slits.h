// Check of repairs: parts of a triangle that are so thin that they became lines.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "check_repair/edge_sums.h"
#include "check_repair/near_triangle.h"

namespace holdfast::checking {

/// Where parts became lines, the rest has odd edges on both banks of a slit. These functions add triangles
/// between the banks that are no facets, as (d) in cover.h allows. The edges where a slit ends at a side are
/// none of the output.
class Slits {
 public:
  /// The edges that are none of the output, with the sides that they are near, as bits.
  using Ends = std::map<Segment, unsigned>;

  /// `odd`: the boundary of the parts, which changes with them.
  Slits(std::set<Segment>& odd, Ends& ends, NearTriangle& near) : odd_(odd), ends_(ends), near_(near) {}

  /// Adds triangles between two odd edges if the third side is short.
  void close_gaps();
  /// Adds triangles between banks that are near each other along their length: from the far end of a slit to
  /// one side, and from one side to another.
  void close();

 private:
  /// The progress along the odd edges on one bank: the current vertex, the previous one, and the side at
  /// which it started, if it did.
  struct Bank {
    Index at, before, start;
  };
  using Banks = std::array<Bank, 2>;

  void close_gap(const Triangle& t);
  [[nodiscard]] Index next_on(const Bank& bank) const;
  [[nodiscard]] bool close_from(Index tip);
  [[nodiscard]] bool close_from_side();
  [[nodiscard]] std::vector<Bank> banks_at_sides();
  [[nodiscard]] bool close_between(const Bank& a, const Bank& b);
  [[nodiscard]] bool close_between(Banks banks, std::vector<Triangle> between, std::optional<Reach> left);
  [[nodiscard]] std::optional<Reach> go_on(Banks& banks, std::vector<Triangle>& between);
  [[nodiscard]] std::optional<Reach> reach_beside(const Segment& a, const Segment& b,
                                                  const Triangle& corners) const;
  void renew() { neighbours_ = neighbours_of(odd_); }

  std::set<Segment>& odd_;
  Ends& ends_;
  NearTriangle& near_;
  Neighbours neighbours_;  // by odd edges
};

}  // namespace holdfast::checking
