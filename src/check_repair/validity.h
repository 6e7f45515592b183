// Check of repairs: whether a surface is a simplicial complex, from nothing but its arrays.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "check/pulse.h"
#include "holdfast/types.h"

namespace holdfast::checking {

/// Calls `found` with a function that gives a sentence for everything in which a surface is no complex; it
/// says whether to go on. Vertices at one place are one here if `merges`, else a violation where both are
/// used. Facets with the same number in `sheet` are taken to lie near to a plane; it may be empty.
using FoundInvalid = std::function<bool(const std::function<std::string()>& sentence)>;
void examine_complex(const Complex& surface, bool merges, std::span<const Index> sheet,
                     const FoundInvalid& found, Pulse& pulse);

}  // namespace holdfast::checking
