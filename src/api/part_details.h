// Finds details of parts that are smaller than a tolerance for pasting.
#pragma once

#include <string>

#include "holdfast/paste.h"
#include "surface/search.h"

namespace holdfast {

/// Finds the vertex nearest to a facet of its own part that does not have it. If its distance is within the
/// tolerance, returns a text that names it and advises what to do; otherwise an empty one. If there are very
/// many, not all are examined.
[[nodiscard]] std::string advice_on_tolerance(const Complex& joined, const PasteResult& of_parts,
                                              double tolerance, const Step& step);

/// The text for a part that was closed and would be open. A tolerance of 0 means none; `gap` is the rounding
/// of coordinates.
[[nodiscard]] std::string opened_text(const PastedPart& part, double tolerance, double gap);

}  // namespace holdfast
