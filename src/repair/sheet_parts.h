// What a surface is once sheets were made one: the parts of sheets in place of the facets that lay in each
// other, and all else cut where its sides are led.
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
  std::vector<Index> facets;   ///< of the state, that it is a part of
  Index sheet;                 ///< as in `State::sheet`
};
using SheetParts = std::map<Index, std::vector<SheetPart>>;  ///< by the first of their facets

/// Facets of a state.
struct InSheets {
  std::vector<std::uint8_t> are_parted;  ///< they are made of parts of sheets from now on
  std::vector<std::uint8_t> overlap;     ///< each some other one
};

struct Delivered {
  double moved = 0;  ///< the largest distance by which parts that were cut again were bent, rounded up
  std::vector<Index> changed;  ///< facets, as they are now, that changed or overlapped others
};

/// All facets and segments again: parts of sheets in the places of their first facets, others cut where their
/// sides are led. Parts that stay whole fit together, and get the number of their sheet.
[[nodiscard]] Delivered deliver_sheets(State& state, const SharedSides& sides, const SheetParts& parts,
                                       const InSheets& in_sheets);

}  // namespace holdfast::repairing
