// The part of a surface that is being bent: facets and segments, their origins, and a queue of those not yet
// examined.
#pragma once

#include <optional>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "arrange/index_table.h"
#include "repair/state.h"

namespace holdfast::repairing {

/// Two vertices, ascending.
using Side = std::array<Index, 2>;

struct BentFacet {
  Triangle corners;
  std::vector<Index> origins;  ///< facets or segments of the state, ascending
  std::vector<Index> lists;    ///< of vertices near it, by number
  double bent = 0;             ///< distance by which its points were moved so far
  bool lives = true;
};

struct BentSegment {
  Segment ends;
  Index origin;
  std::vector<Index> lists;
  double bent = 0;  ///< largest distance of its points from the origin
  bool lives = true;
};

/// No two live facets have the same corners: facets that come to have the same corners become one, with the
/// origins of both. The same holds for segments of one origin.
class BentSurface {
 public:
  explicit BentSurface(const std::vector<Point>& vertices) : vertices_(vertices) {}

  [[nodiscard]] const BentFacet& facet(Index f) const { return facets_[f]; }
  [[nodiscard]] const BentSegment& segment(Index s) const { return segments_[s]; }
  [[nodiscard]] const std::vector<BentFacet>& facets() const { return facets_; }
  [[nodiscard]] const std::vector<BentSegment>& segments() const { return segments_; }
  /// The live facets.
  [[nodiscard]] std::size_t living() const { return living_; }
  /// The largest distance by which anything was bent.
  [[nodiscard]] double most() const { return most_; }

  /// `is_idle`: nothing near the facet can lead its sides, so they need not be examined because of it.
  void add(BentFacet facet, bool is_idle = false);
  /// Whether a facet with these corners was taken out, and did not come back.
  [[nodiscard]] bool had(const Triangle& corners) const;
  void add(const BentSegment& segment, bool is_idle = false);
  /// The same for a segment of this origin.
  [[nodiscard]] bool had(const Segment& ends, Index origin) const;
  /// Takes out what lives, for its parts to be added: it comes back, bent by some more.
  [[nodiscard]] BentFacet take(Index facet, double more);
  /// The same for a segment: no point of its parts is further than this from its origin.
  [[nodiscard]] BentSegment take_segment(Index segment, double distance);

  /// What has a side, or had it before it ended.
  struct AtSide {
    std::vector<Index> facets, segments;
  };
  /// The longest side not examined since an element first got it. Sides that only idle elements have are left
  /// out.
  [[nodiscard]] std::optional<Side> next_side();
  [[nodiscard]] const AtSide* at(const Side& side) const;
  /// When all that has it is taken out. Returns what had it.
  AtSide forget(const Side& side);
  /// The last facet with lists that was not examined.
  [[nodiscard]] std::optional<Index> next_facet();

 private:
  struct SideNote {
    AtSide at;
    bool is_there = false;   // nobody forgot it
    bool is_queued = false;  // since then
  };
  using Waiting = std::pair<double, Side>;  // a side and its length
  AtSide& note(const Side& side, bool is_idle);
  void wake_sides(const Triangle& corners);

  const std::vector<Point>& vertices_;
  std::vector<BentFacet> facets_;
  std::vector<BentSegment> segments_;
  std::size_t living_ = 0;
  arrange::IndexTable<3> corners_;   // the numbers of corners, ascending
  std::vector<Index> facet_with_;    // by their numbers, the last that had them
  arrange::IndexTable<3> ends_;      // the numbers of ends, ascending, and an origin
  std::vector<Index> segment_with_;  // by their numbers, the last that had them
  arrange::IndexTable<2> side_numbers_;
  std::vector<SideNote> at_side_;  // by their numbers
  // Sides to look at: most are there before the first one is looked at, so a sorted list holds these.
  std::vector<Waiting> first_sides_;
  std::priority_queue<Waiting> sides_;
  std::optional<Waiting> least_;  // of those that were looked at
  std::vector<Index> whole_;      // facets to look at
  double most_ = 0;
};

}  // namespace holdfast::repairing
