// Rebuilds a surface after sheets were made one: the parts of sheets replace the coincident facets, and all
// other facets are cut where their sides are led.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "repair/shared_sides.h"
#include "repair/state.h"

namespace holdfast::repairing {

/// A facet of a sheet.
struct SheetPart {
  Triangle corners;
  std::vector<Index> parents;  ///< facets of the input
  std::vector<Index> facets;   ///< facets of the state that it is a part of
  Index sheet;                 ///< as in `State::sheet`
};
using SheetParts = std::map<Index, std::vector<SheetPart>>;  ///< by the first of its facets

/// Facets of a state.
struct InSheets {
  std::vector<std::uint8_t> are_parted;  ///< whether parts of sheets replace the facet
  std::vector<std::uint8_t> overlap;     ///< whether the facet overlaps another one
};

struct Delivered {
  double moved = 0;            ///< largest distance by which parts that were cut again were bent, rounded up
  std::vector<Index> changed;  ///< facets, by their present numbers, that changed or overlapped others
};

/// Rewrites all facets and segments: parts of sheets take the places of their first facets, and the others
/// are cut where their sides are led. Parts that stay whole fit together and get the number of their sheet.
[[nodiscard]] Delivered deliver_sheets(State& state, const SharedSides& sides, const SheetParts& parts,
                                       const InSheets& in_sheets);

}  // namespace holdfast::repairing
