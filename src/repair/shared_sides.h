// The vertices that shared sides are led through, when several sheets lead a side through their own vertices.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "holdfast/types.h"

namespace holdfast::repairing {

/// Chains are added one after the other, each from one end of its side to the other. Nearby vertices of two
/// chains become one. The other vertices are merged in order along the side, so each part of a chain is led
/// through the vertices that come to lie between its ends. The final chain of a side depends only on the ends
/// of the side, in every facet, so no crack opens.
class SharedSides {
 public:
  /// New vertices may be added to `vertices`. The vertices there now never become others.
  SharedSides(const std::vector<Point>& vertices, double gap)
      : vertices_(vertices), gap_(gap), old_(vertices.size()) {}

  /// Whether a chain is compatible with the chains that the side already has.
  [[nodiscard]] bool fits(Index a, Index b, std::span<const Index> chain) const;
  void add(Index a, Index b, std::span<const Index> chain);
  /// Whether a side, with its ends ascending, has any chain, even an empty one.
  [[nodiscard]] bool is_told(const std::array<Index, 2>& side) const { return chains_.contains(side); }
  /// The later of two vertices becomes the earlier one, unless it is one of the first vertices.
  void unite(Index v, Index w, std::size_t first);

  /// Resolves all chains; false if they contradict each other.
  [[nodiscard]] bool finish();
  /// The vertex that a vertex has become.
  [[nodiscard]] Index root(Index v) const;
  /// The vertices of the side from a to b, without a and b.
  [[nodiscard]] std::vector<Index> chain(Index a, Index b) const;
  /// Whether there are any.
  [[nodiscard]] bool is_led(Index a, Index b) const {
    return !known({std::min(a, b), std::max(a, b)}).empty();
  }
  [[nodiscard]] bool has_united() const { return !into_.empty(); }
  /// The largest distance between a vertex and the one that it became, rounded up.
  [[nodiscard]] double most() const { return most_; }

 private:
  using Side = std::array<Index, 2>;  // ascending
  using Chains = std::map<Side, std::vector<Index>>;

  /// Two chains merged.
  struct Joined {
    std::vector<Index> all;
    std::vector<std::array<Index, 2>> same;  // pairs of nearby vertices, one of each chain
  };

  [[nodiscard]] const Point& at(Index v) const { return vertices_[v]; }
  [[nodiscard]] std::span<const Index> known(const Side& side) const;
  [[nodiscard]] std::size_t same_as(Index v, std::span<const Index> before, std::size_t first,
                                    std::span<const Index> chain) const;
  [[nodiscard]] std::optional<Joined> joined(const Side& side, std::span<const Index> before,
                                             std::span<const Index> chain) const;
  void add(const Side& side, std::vector<Index> chain);
  void divide(const Side& side, std::span<const Index> chain, std::span<const Index> all);
  [[nodiscard]] std::vector<Index> whole(const Side& side, std::span<const Index> chain) const;
  [[nodiscard]] bool expand(const Side& side, std::map<Side, bool>& is_done);

  const std::vector<Point>& vertices_;
  double gap_;
  const std::size_t old_;
  Chains chains_;
  std::map<Index, Index> into_;  // vertices that became others, with lower numbers
  double most_ = 0;
  bool contradicts_ = false;
};

}  // namespace holdfast::repairing
