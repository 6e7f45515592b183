// Facets that are made from those of a surface under repair.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "numbers/sorted.h"
#include "repair/state.h"

namespace holdfast::repairing {

class DerivedFacets {
 public:
  explicit DerivedFacets(const State& from) : from_(from) {}

  /// Adds a facet with the parents of some facets of the surface, each parent once.
  void add(const Triangle& corners, std::span<const Index> origins) {
    facets_.push_back(corners);
    list_.clear();
    for (const Index f : origins) {
      const auto parents = from_.facet_parents.of(f);
      list_.insert(list_.end(), parents.begin(), parents.end());
    }
    sort_unique(list_);
    parents_.add(list_);
  }

  /// Replaces the facets of a surface, which may be the one that they are made from.
  void move_to(State& state) && {
    state.facets = std::move(facets_);
    state.facet_parents = std::move(parents_);
  }

 private:
  const State& from_;
  std::vector<Triangle> facets_;
  Parents parents_;
  std::vector<Index> list_;
};

}  // namespace holdfast::repairing
