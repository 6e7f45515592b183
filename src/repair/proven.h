// The facets that an exact search has found to fit together. Attempts that start again use them, since most
// of a surface comes out of each attempt unchanged.
#pragma once

#include <vector>

#include "arrange/index_table.h"
#include "repair/state.h"

namespace holdfast::repairing {

class Proven {
 public:
  /// The facets of a state that are known to fit together.
  explicit Proven(const State& state);

  /// Marks these facets as known in another state, unless that state knows of more facets by itself. The two
  /// sets are never merged: facets of one are not known to fit together with facets of the other.
  void tell(State& state) const;

 private:
  using Words = std::array<Index, 6>;  // of a point

  [[nodiscard]] static Words words_of(const Point& p);

  arrange::IndexTable<6> points_;
  arrange::IndexTable<3> facets_;  // by the numbers of their corners, ascending
  Index count_ = 0;                // of facets
};

}  // namespace holdfast::repairing
