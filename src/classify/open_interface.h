// Interfaces that lack triangles: facets with the same region on both sides that would part it in two.
//
// Add some faces of the mesh to a sheet of facets. They divide the sheet's region in two if every path from
// one side of the sheet to the other goes through one of them. The fewest such faces are a least cut between
// the tetrahedra on the two sides (Ford, Fulkerson 1956; here by Dinic's method). Where these are few beside
// the facets of the sheet, an interface has an opening; of a sheet that merely juts into a region, as many
// are needed as it has facets, or more.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "classify/keep.h"
#include "holdfast/holdfast.h"
#include "surface/complex.h"
#include "surface/places.h"

namespace holdfast {

/// One warning for each sheet in a kept region with such an opening. The two parts that it would make must
/// both lie at other facets, too; if these have the same markers on both sides, the opening must take less
/// than half as many faces as the sheet has facets, else no more.
///
/// `tell` is called from time to time, and may throw.
[[nodiscard]] std::vector<Warning> find_open_interfaces(TetMesh& mesh, const Regions& regions,
                                                        const Kept& kept, const NamedComplex& input,
                                                        const std::function<void()>& tell);

}  // namespace holdfast
