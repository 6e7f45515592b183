// What sides are led through, where each of several sheets that have a side leads it through vertices of its
// own.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "holdfast/types.h"

namespace holdfast::repairing {

/// Chains are told one after the other, each from one end of its side to the other. Vertices of two that are
/// near to each other become one; others follow each other along the side, and so each part of a chain is led
/// through what comes to lie between its ends. What a side is led through in the end depends on its ends
/// alone, in whatever facet it is, so that no crack opens.
class SharedSides {
 public:
  /// Of the vertices, to which new ones may be added, those that are there now do not become others.
  SharedSides(const std::vector<Point>& vertices, double gap)
      : vertices_(vertices), gap_(gap), old_(vertices.size()) {}

  /// Whether a chain can follow what the side is led through already.
  [[nodiscard]] bool fits(Index a, Index b, std::span<const Index> chain) const;
  void add(Index a, Index b, std::span<const Index> chain);
  /// Whether any chain, be it empty, was told of a side, whose ends ascend.
  [[nodiscard]] bool is_told(const std::array<Index, 2>& side) const { return chains_.contains(side); }
  /// The later of two vertices becomes the other one, if it is not one of the first.
  void unite(Index v, Index w, std::size_t first);

  /// Ends with what was told; false where that contradicts itself.
  [[nodiscard]] bool finish();
  /// What a vertex has become.
  [[nodiscard]] Index root(Index v) const;
  /// What a side is led through from a to b, without these.
  [[nodiscard]] std::vector<Index> chain(Index a, Index b) const;
  /// Whether that is anything.
  [[nodiscard]] bool is_led(Index a, Index b) const {
    return !known({std::min(a, b), std::max(a, b)}).empty();
  }
  [[nodiscard]] bool has_united() const { return !into_.empty(); }
  /// The furthest that a vertex went to become another one, rounded up.
  [[nodiscard]] double most() const { return most_; }

 private:
  using Side = std::array<Index, 2>;  // ascending
  using Chains = std::map<Side, std::vector<Index>>;

  /// Two chains in one.
  struct Joined {
    std::vector<Index> all;
    std::vector<std::array<Index, 2>> same;  // vertices of the one that are near to one of the other
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
  std::map<Index, Index> into_;  // vertices that became others of lower numbers
  double most_ = 0;
  bool contradicts_ = false;
};

}  // namespace holdfast::repairing
