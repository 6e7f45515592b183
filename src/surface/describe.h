// Surface layer: turns findings into defects, with entities, places and one sentence each.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "holdfast/types.h"
#include "surface/search.h"

namespace holdfast {

/// "(x, y, z)" for messages.
[[nodiscard]] std::string place(const Point& p);

/// What is wrong with a single entity, or with two identical vertices.
[[nodiscard]] Defect describe(const Complex& complex, const Flaw& flaw);

/// Elements by their vertices, for the lists in defects.
class Stars {
 public:
  explicit Stars(const Complex& complex, const Elements& elements);

  /// Elements (indices of Elements::all, ascending) with all of these vertices.
  [[nodiscard]] std::vector<Index> elements_at(const Corners& corners) const;
  /// The first of the complex's segments with these ends, or `no_index`.
  [[nodiscard]] Index input_segment(const Corners& corners) const;

 private:
  const Elements& elements_;
  std::vector<std::size_t> first_;  // CSR by vertex
  std::vector<Index> at_;
  std::vector<std::pair<Segment, Index>> segments_;
};

/// Two simplices whose interiors meet.
[[nodiscard]] Defect describe(const Complex& complex, const Elements& elements, const Stars& stars,
                              const Finding& finding);

}  // namespace holdfast
