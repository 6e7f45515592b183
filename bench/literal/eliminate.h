// Elimination as the paper tells it (§5.3, §6.3): all points of facets, then all points of segments with the
// facets standing, and each point becomes as many as there are parts of its ball, all left in its place.
#pragma once

#include <span>
#include <vector>

#include "enforce/partition.h"
#include "literal/soup.h"
#include "numbers/random.h"

namespace holdfast::literal {

struct EliminationCounts {
  std::size_t in_facets = 0;             ///< points taken off facets
  std::vector<std::size_t> on_segments;  ///< points taken off segments, by the number of their facets
  std::size_t copies = 0;                ///< vertices added in the places of these
  std::size_t emulated = 0;  ///< polygons guessed among the mesh's faces, where facets are too few
  std::size_t left = 0;      ///< points for which none was found: they stay
};

/// Takes the points of a partition off its constraints. `facets` are the complex's, `pieces` those that are
/// several faces of the mesh, which the soup knows.
EliminationCounts eliminate(Soup& soup, const ConstraintPieces& pieces, std::span<const Triangle> facets,
                            numbers::Random& random);

}  // namespace holdfast::literal
