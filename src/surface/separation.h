// Surface layer: the regions into which a valid surface cuts space, by counting alone.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "surface/complex.h"

namespace holdfast {

/// Space without the facets of a valid complex, by Alexander duality: two points lie in one region exactly if
/// a path between them crosses an even number of facets of every 2-cycle over Z/2, that is, of every set of
/// facets that has an even number round each segment.
///
/// If a cycle holds a facet, it also holds the facets across segments of two facets, and it never holds
/// facets that can be peeled off from borders. So there are few unknowns: patches between segments of three
/// or more facets, with one equation for each of these segments.
class Separation {
 public:
  explicit Separation(const SegmentTable& table);

  /// The number of bounded regions: the rank of the second homology group.
  [[nodiscard]] std::size_t enclosed() const { return unknowns_ - equations_.size(); }

  /// A name of the region at the end of a path from infinity that crosses `facets`, where a facet is listed
  /// once for each crossing. All paths to the same region give the same name. Empty for the unbounded region.
  using Region = std::vector<Index>;
  [[nodiscard]] Region beyond(std::span<const Index> facets) const;

 private:
  std::vector<Index> patch_;           // by facet; no_index for facets in no cycle
  std::map<Index, Region> equations_;  // echelon form over Z/2, by the first patch of each
  std::size_t unknowns_ = 0;
};

}  // namespace holdfast
