// Reports elements outside the chosen regions as defects (docs/concepts.md, Regions).
#pragma once

#include <vector>

#include "classify/keep.h"

namespace holdfast {

/// A surface without any bounded region: names the open borders.
[[nodiscard]] Defect encloses_nothing(const NamedComplex& input);

/// Facets, dangling segments and isolated vertices that border on no kept region: one defect for each
/// connected set of them. `kept` has its regions and segments.
[[nodiscard]] std::vector<Defect> find_outside(const TetMesh& mesh, const Regions& regions, const Kept& kept,
                                               const NamedComplex& input);

}  // namespace holdfast
