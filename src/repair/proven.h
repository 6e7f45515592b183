// Which facets an exact search has found to fit together, for attempts that begin again: most of a surface
// comes out of them as it came out before.
#pragma once

#include <vector>

#include "arrange/index_table.h"
#include "repair/state.h"

namespace holdfast::repairing {

class Proven {
 public:
  /// The facets of a state that are known to fit together.
  explicit Proven(const State& state);

  /// Lets another state know of those that it has, too, if it knows of fewer by itself: what is known of it
  /// from elsewhere is not known to fit together with these.
  void tell(State& state) const;

 private:
  using Words = std::array<Index, 6>;  // of a point

  [[nodiscard]] static Words words_of(const Point& p);

  arrange::IndexTable<6> points_;
  arrange::IndexTable<3> facets_;  // by the numbers of their corners, ascending
  Index count_ = 0;                // of facets
};

}  // namespace holdfast::repairing
