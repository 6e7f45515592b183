// Regions of parts that were pasted together: which parts hold each region, and whose it is
// (docs/pasting.md).
//
// The space of a part is found as if the part were alone: facets of other parts are ignored, and regions that
// only they divide are one. The part's own facets then give winding numbers. If they are not oriented
// consistently, the part holds its bounded regions.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "classify/regions.h"
#include "holdfast/paste.h"
#include "surface/complex.h"

namespace holdfast {

/// A facet that bounds a part.
struct PartWall {
  Index part;
  bool is_turned;  ///< the part's facet is turned against the complex's
};

/// What a complex is made of.
struct PartsOfComplex {
  std::vector<std::size_t> first{0};  ///< by facet: where its walls begin, and where the last one's end
  std::vector<PartWall> walls;
  std::span<const PastedPart> parts;
  Overlap overlap = Overlap::refuse;
  double gap = 0;  ///< common space of parts that is at most this thick is no overlap
  /// Number of the caller's seeds in the options; the seeds after them are the parts', for their sizes.
  std::size_t seeds = 0;
  std::vector<PartOverlap> overlaps;  ///< that were found

  [[nodiscard]] bool refuses() const { return overlap == Overlap::refuse && !overlaps.empty(); }
  [[nodiscard]] std::span<const PartWall> of_facet(std::size_t f) const {
    return std::span(walls).subspan(first[f], first[f + 1] - first[f]);
  }
};

/// The parts that hold each region, with each part taken alone.
struct Holders {
  struct Claim {
    Index part;
    std::optional<int> id;  ///< that a seed of the part gives
  };
  std::vector<std::vector<Claim>> of_region;  ///< in ascending order of parts
  /// Two facets that leave a part without winding numbers, and those that are turned against others.
  std::optional<std::array<Index, 2>> conflict;
  std::vector<Index> turned;
};

/// Finds the region of a seed or hole; throws std::invalid_argument for places without meaning.
using FindRegion = std::function<RegionId(const Point& where, const char* what)>;

/// `keep` is the rule for each part: automatic, bounded or winding.
[[nodiscard]] Holders find_holders(const Regions& regions, const PartsOfComplex& parts, Keep keep,
                                   const FindRegion& find);

/// The mean thickness of regions that several parts hold: twice the volume over the area. 0 for other
/// regions. Measures of the complex times 2^scale do not overflow or underflow.
[[nodiscard]] std::vector<double> thickness_of_common(const Regions& regions, const Holders& holders,
                                                      const Complex& complex, int scale);

/// Leaves one claim, of the first part (or of the last, if `parts.overlap` says so), on regions whose mean
/// thickness is at most `parts.gap`.
void settle_thin_regions(const std::vector<double>& thickness, const PartsOfComplex& parts, Holders& holders);

/// The pairs of parts that hold regions in common, and how deep these are.
[[nodiscard]] std::vector<PartOverlap> find_overlaps(const Regions& regions, const Holders& holders,
                                                     const Complex& complex,
                                                     const std::vector<double>& thickness);

/// One sentence on the deepest of some overlaps.
[[nodiscard]] std::string overlap_message(const PartsOfComplex& parts);

/// The id of each region that some part holds, or nothing. `parts.overlap` decides regions that several parts
/// hold.
[[nodiscard]] std::vector<std::optional<int>> ids_of_held(const Holders& holders,
                                                          const PartsOfComplex& parts);

}  // namespace holdfast
