// Surface layer: into which regions a valid surface cuts space, by counting alone.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "surface/complex.h"

namespace holdfast {

/// Space without the facets of a valid complex, by Alexander duality: two points lie in one region exactly
/// if a path between them crosses an even number of facets of every 2-cycle over Z/2, that is, of every set
/// of facets that has an even number round each segment.
///
/// A cycle holds, with one facet, all those that follow across segments of two facets, and none of those
/// that can be peeled off from borders. So the unknowns are few, patches between segments of three facets or
/// more, with an equation for each of these.
class Separation {
 public:
  explicit Separation(const SegmentTable& table);

  /// The number of bounded regions: the rank of the second homology group.
  [[nodiscard]] std::size_t enclosed() const { return unknowns_ - equations_.size(); }

  /// A name of the region where a path from infinity ends that crosses `facets`, each as often as it is
  /// named: the same for all paths that end there. Empty for the unbounded region.
  using Region = std::vector<Index>;
  [[nodiscard]] Region beyond(std::span<const Index> facets) const;

 private:
  std::vector<Index> patch_;           // by facet; no_index for those that no cycle holds
  std::map<Index, Region> equations_;  // echelon form over Z/2, by the first patch of each
  std::size_t unknowns_ = 0;
};

}  // namespace holdfast
