// Finds details of parts that are smaller than a tolerance for pasting.
#pragma once

#include <string>

#include "holdfast/paste.h"
#include "surface/search.h"

namespace holdfast {

/// Looks for the vertex that is nearest to a facet of its own part which does not have it. Where that is
/// within the tolerance, tells it and what to do; else empty. Where there are very many, not all are looked
/// at.
[[nodiscard]] std::string advice_on_tolerance(const Complex& joined, const PasteResult& of_parts,
                                              double tolerance, const Step& step);

/// That a part was closed and would not be; a tolerance of 0 is none, and `gap` what coordinates are rounded
/// by.
[[nodiscard]] std::string opened_text(const PastedPart& part, double tolerance, double gap);

}  // namespace holdfast
