// The planes of facets that others meet, each computed once.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "exact/space_point.h"
#include "holdfast/types.h"
#include "mesh/parallel.h"
#include "surface/elements.h"

namespace holdfast::arrange {

class FacetPlanes {
 public:
  /// `used`: for each element whether it is a facet whose plane will be asked for.
  FacetPlanes(const Complex& complex, const Elements& elements, const std::vector<std::uint8_t>& used,
              const Threads& threads);

  /// Of a facet, an index of Elements::all.
  [[nodiscard]] const exact::SpacePlane& operator[](Index facet) const { return planes_[plane_[facet]]; }

 private:
  std::vector<Index> plane_;  // by element
  std::vector<exact::SpacePlane> planes_;
};

}  // namespace holdfast::arrange
