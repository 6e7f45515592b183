// The method of §5 and §6 as the paper tells it, step by step: all constraints are partitioned before the
// first point goes, points become several in one place, and untangling makes the mesh positive in the end.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "holdfast/check.h"
#include "holdfast/untangle.h"
#include "literal/eliminate.h"
#include "literal/insert.h"
#include "literal/soup.h"

namespace holdfast::literal {

struct How {
  std::uint64_t seed = 1;
  bool flips = false;      ///< recover by flips first (§4); else partition does all
  bool grow = true;        ///< points of segments by generalized cavities (Fig. 10); else by local splits
  bool untangle = true;    ///< to the end; else the mesh is left as elimination leaves it
  double time_limit = 60;  ///< seconds, of untangling; 0: none
  std::size_t most_points = SIZE_MAX;  ///< of the partition; beyond, the run is given up
};

struct Told {
  std::size_t facets = 0, segments = 0, missing_facets = 0, missing_segments = 0;
  std::size_t segment_points = 0, facet_points = 0;
  InsertionCounts insertion;
  InsertionPicture picture;  ///< of the insertion that added most visible tetrahedra
  EliminationCounts elimination;
  Soup::Counts before, after;  ///< elimination, in the whole box
  Soup::Counts inside;         ///< in what is kept
  bool whole_box = false;      ///< the surface encloses nothing: all is kept
  std::string ended;           ///< "done", or where it ended otherwise
  std::string message;         ///< why
  UntangleReport untangling;
  std::size_t vertices = 0, tetrahedra = 0;
};

struct Run {
  Told told;
  Volume tangled;  ///< after elimination
  Volume volume;   ///< in the end; empty unless `told.ended` is "done"
};

/// Of a valid surface without repeated vertices.
[[nodiscard]] Run run(const Surface& surface, const How& how);

}  // namespace holdfast::literal
