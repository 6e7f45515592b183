// Surface layer: hubs, vertices of many elements. The boxes of all elements at a vertex overlap, so the tree
// of boxes would compare all pairs. These elements are searched by direction instead: two cones from one
// vertex meet outside it only if their arcs on a small sphere round it meet.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "surface/aabb_tree.h"
#include "surface/elements.h"

namespace holdfast {

struct Hub {
  Index vertex;
  std::vector<Index> elements;  ///< indices of Elements::all
};

class Hubs {
 public:
  /// Vertices with at least `degree` facets and segments are hubs.
  Hubs(const Complex& complex, const Elements& elements, std::size_t degree);

  [[nodiscard]] const std::vector<Hub>& all() const { return hubs_; }
  /// The hubs (indices of `all`) among an element's corners; unused places hold `no_index`.
  [[nodiscard]] const std::array<Index, 3>& of(Index element) const { return of_[element]; }
  /// The same of all elements; empty if there is no hub.
  [[nodiscard]] std::span<const std::array<Index, 3>> of() const { return of_; }
  /// The least hub that two elements share, or `no_index`.
  [[nodiscard]] Index shared(Index a, Index b) const;
  /// For each element, its hub with the most elements, or `no_index`: this groups the elements in fans.
  [[nodiscard]] std::vector<Index> fans() const;
  /// Boxes round the directions of the hub's elements, in the order of the elements. If two boxes are
  /// disjoint, their elements meet in the hub's vertex only.
  [[nodiscard]] std::vector<Box> directions(const Hub& hub) const;

 private:
  const Complex& complex_;
  const Elements& elements_;
  std::vector<Hub> hubs_;
  std::vector<std::array<Index, 3>> of_;  // empty if there is no hub
};

}  // namespace holdfast
