// Facets of parts that are put together: the part and the plane of each. Whatever is measured here is
// floating point: it chooses what is joined.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "holdfast/plane.h"
#include "repair/near.h"
#include "repair/state.h"

namespace holdfast::repairing {

/// A facet's plane.
struct PlaneOf {
  Vector normal{};    ///< of length 1
  double height = 0;  ///< the facet's least
  std::size_t axis = 0;
};

class PartFacets {
 public:
  /// `part` tells the part of each facet of the input. The facets of the state stay as they are as long as
  /// this is used; vertices may be added.
  PartFacets(const State& state, std::span<const Index> part);

  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] std::size_t size() const { return planes_.size(); }
  [[nodiscard]] const Triangle& corners(Index f) const { return state_.facets[f]; }
  [[nodiscard]] const Point& at(Index v) const { return state_.vertices[v]; }
  [[nodiscard]] Index part_of(Index f) const { return part_[state_.facet_parents.of(f)[0]]; }
  /// Facets that parts have in common already stay as they are.
  [[nodiscard]] bool is_shared(Index f) const { return state_.facet_parents.of(f).size() > 1; }
  /// Nothing for facets that are none.
  [[nodiscard]] const std::optional<PlaneOf>& plane(Index f) const { return planes_[f]; }
  /// The parts that have a vertex, ascending.
  [[nodiscard]] const std::vector<Index>& parts_at(Index v) const { return parts_at_[v]; }
  /// Of facets the one with the greatest height.
  [[nodiscard]] Index widest(const std::vector<Index>& facets) const;

  // In two of the three coordinates, without the one along the axis.
  [[nodiscard]] PlanePoint flat(Index v, std::size_t axis) const {
    return {at(v)[(axis + 1) % 3], at(v)[(axis + 2) % 3]};
  }
  /// Twice the area, signed.
  [[nodiscard]] double area(const Triangle& t, std::size_t axis) const;
  [[nodiscard]] bool holds(const Triangle& t, const PlanePoint& p, std::size_t axis) const;

  /// How far the corners of a triangle lie from a facet at most.
  [[nodiscard]] double distance(const Triangle& t, Index facet) const;

 private:
  [[nodiscard]] std::optional<PlaneOf> plane_of(const Triangle& t) const;

  const State& state_;
  const std::span<const Index> part_;
  std::vector<std::optional<PlaneOf>> planes_;
  std::vector<std::vector<Index>> parts_at_;
};

}  // namespace holdfast::repairing
