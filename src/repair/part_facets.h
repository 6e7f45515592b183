// Facets of parts that are pasted: the part and the plane of each. All measures here are floating point: they
// only choose what is joined.
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
  Vector normal{};    ///< unit length
  double height = 0;  ///< the least height of the facet
  std::size_t axis = 0;
};

class PartFacets {
 public:
  /// `part` holds the part of each facet of the input. While this object is in use, the facets of the state
  /// must not change; vertices may be added.
  PartFacets(const State& state, std::span<const Index> part);

  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] std::size_t size() const { return planes_.size(); }
  [[nodiscard]] const Triangle& corners(Index f) const { return state_.facets[f]; }
  [[nodiscard]] const Point& at(Index v) const { return state_.vertices[v]; }
  [[nodiscard]] Index part_of(Index f) const { return part_[state_.facet_parents.of(f)[0]]; }
  /// Facets that parts have in common already stay as they are.
  [[nodiscard]] bool is_shared(Index f) const { return state_.facet_parents.of(f).size() > 1; }
  /// Nothing for degenerate facets.
  [[nodiscard]] const std::optional<PlaneOf>& plane(Index f) const { return planes_[f]; }
  /// The parts that have a vertex, ascending.
  [[nodiscard]] const std::vector<Index>& parts_at(Index v) const { return parts_at_[v]; }
  /// The facet with the greatest height.
  [[nodiscard]] Index widest(const std::vector<Index>& facets) const;

  // In two of the three coordinates, without the one along the axis.
  [[nodiscard]] PlanePoint flat(Index v, std::size_t axis) const {
    return {at(v)[(axis + 1) % 3], at(v)[(axis + 2) % 3]};
  }
  /// Twice the area, signed.
  [[nodiscard]] double area(const Triangle& t, std::size_t axis) const;
  [[nodiscard]] bool holds(const Triangle& t, const PlanePoint& p, std::size_t axis) const;

  /// Largest distance of a triangle's corner from a facet.
  [[nodiscard]] double distance(const Triangle& t, Index facet) const;

 private:
  [[nodiscard]] std::optional<PlaneOf> plane_of(const Triangle& t) const;

  const State& state_;
  const std::span<const Index> part_;
  std::vector<std::optional<PlaneOf>> planes_;
  std::vector<std::vector<Index>> parts_at_;
};

}  // namespace holdfast::repairing
