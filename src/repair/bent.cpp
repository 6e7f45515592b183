#include "repair/bent.h"

#include <algorithm>
#include <iterator>

#include "numbers/sorted.h"
#include "repair/near.h"
#include "surface/complex.h"

namespace holdfast::repairing {
namespace {

/// Both lists ascend, and usually they are equal.
void join(std::vector<Index>& list, const std::vector<Index>& other) {
  if (std::includes(list.begin(), list.end(), other.begin(), other.end())) return;
  std::vector<Index> both;
  both.reserve(list.size() + other.size());
  std::set_union(list.begin(), list.end(), other.begin(), other.end(), std::back_inserter(both));
  list = std::move(both);
}

}  // namespace

void BentSurface::add(BentFacet facet, bool is_idle) {
  most_ = std::max(most_, facet.bent);
  const auto fresh = static_cast<Index>(facets_.size());
  const auto next = static_cast<Index>(facet_with_.size());
  const Index number = corners_.find_or_add(ascending(facet.corners), next);
  if (number == next) {
    facet_with_.push_back(fresh);
  } else if (BentFacet& other = facets_[facet_with_[number]]; other.lives) {
    join(other.origins, facet.origins);
    join(other.lists, facet.lists);
    other.bent = std::max(other.bent, facet.bent);
    if (!is_idle) wake_sides(other.corners);
    return;
  }
  facet_with_[number] = fresh;
  for (std::size_t i = 0; i < 3; ++i)
    note(ascending(Side{facet.corners[i], facet.corners[(i + 1) % 3]}), is_idle).facets.push_back(fresh);
  if (!facet.lists.empty()) whole_.push_back(fresh);
  facets_.push_back(std::move(facet));
  ++living_;
}

void BentSurface::add(const BentSegment& segment, bool is_idle) {
  most_ = std::max(most_, segment.bent);
  const auto fresh = static_cast<Index>(segments_.size());
  const Side ends = ascending(Side(segment.ends));
  const auto next = static_cast<Index>(segment_with_.size());
  const Index number = ends_.find_or_add({ends[0], ends[1], segment.origin}, next);
  if (number == next) {
    segment_with_.push_back(fresh);
  } else if (BentSegment& other = segments_[segment_with_[number]]; other.lives) {
    other.bent = std::max(other.bent, segment.bent);
    return;
  }
  segment_with_[number] = fresh;
  segments_.push_back(segment);
  note(ends, is_idle).segments.push_back(fresh);
}

bool BentSurface::had(const Triangle& corners) const {
  const Index number = corners_.find(ascending(corners));
  return number != no_entity && !facets_[facet_with_[number]].lives;
}

bool BentSurface::had(const Segment& ends, Index origin) const {
  const auto [a, b] = ascending(Side(ends));
  const Index number = ends_.find({a, b, origin});
  return number != no_entity && !segments_[segment_with_[number]].lives;
}

BentFacet BentSurface::take(Index facet, double more) {
  facets_[facet].lives = false;
  --living_;
  BentFacet taken = facets_[facet];
  taken.lives = true;
  taken.bent += more;
  most_ = std::max(most_, taken.bent);
  return taken;
}

BentSegment BentSurface::take_segment(Index segment, double distance) {
  segments_[segment].lives = false;
  BentSegment taken = segments_[segment];
  taken.lives = true;
  taken.bent = std::max(taken.bent, distance);
  return taken;
}

BentSurface::AtSide& BentSurface::note(const Side& side, bool is_idle) {
  const auto next = static_cast<Index>(at_side_.size());
  const Index number = side_numbers_.find_or_add(side, next);
  if (number == next) at_side_.emplace_back();
  SideNote& note = at_side_[number];
  const bool was_there = std::exchange(note.is_there, true);
  if (!was_there) note.is_queued = false;
  if (is_idle || note.is_queued) return note.at;
  const Waiting waiting(length(vertices_[side[0]] - vertices_[side[1]]), side);
  // The turn of a side that was idle is past when a shorter one was looked at.
  if (was_there && least_ && *least_ < waiting) return note.at;
  note.is_queued = true;
  if (least_)
    sides_.push(waiting);
  else
    first_sides_.push_back(waiting);
  return note.at;
}

void BentSurface::wake_sides(const Triangle& corners) {
  for (std::size_t i = 0; i < 3; ++i) note(ascending(Side{corners[i], corners[(i + 1) % 3]}), false);
}

const BentSurface::AtSide* BentSurface::at(const Side& side) const {
  const Index number = side_numbers_.find(side);
  return number == no_entity || !at_side_[number].is_there ? nullptr : &at_side_[number].at;
}

BentSurface::AtSide BentSurface::forget(const Side& side) {
  const Index number = side_numbers_.find(side);
  if (number == no_entity) return {};
  at_side_[number].is_there = false;
  return std::exchange(at_side_[number].at, {});
}

std::optional<Side> BentSurface::next_side() {
  if (!least_) std::sort(first_sides_.begin(), first_sides_.end());
  if (first_sides_.empty() && sides_.empty()) return std::nullopt;
  Waiting longest;
  if (sides_.empty() || (!first_sides_.empty() && sides_.top() < first_sides_.back())) {
    longest = first_sides_.back();
    first_sides_.pop_back();
  } else {
    longest = sides_.top();
    sides_.pop();
  }
  least_ = least_ ? std::min(*least_, longest) : longest;
  return longest.second;
}

std::optional<Index> BentSurface::next_facet() {
  if (whole_.empty()) return std::nullopt;
  const Index f = whole_.back();
  whole_.pop_back();
  return f;
}

}  // namespace holdfast::repairing
