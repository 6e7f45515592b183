#include "repair/bent.h"

#include <algorithm>

#include "numbers/sorted.h"
#include "repair/near.h"
#include "surface/complex.h"

namespace holdfast::repairing {
namespace {

void join(std::vector<Index>& list, const std::vector<Index>& other) {
  list.insert(list.end(), other.begin(), other.end());
  sort_unique(list);
}

}  // namespace

void BentSurface::add(BentFacet facet) {
  most_ = std::max(most_, facet.bent);
  const auto fresh = static_cast<Index>(facets_.size());
  const auto [found, is_new] = facet_with_.try_emplace(ascending(facet.corners), fresh);
  if (!is_new && facets_[found->second].lives) {
    BentFacet& other = facets_[found->second];
    join(other.origins, facet.origins);
    join(other.lists, facet.lists);
    other.bent = std::max(other.bent, facet.bent);
    return;
  }
  found->second = fresh;
  for (std::size_t i = 0; i < 3; ++i)
    note(ascending(Side{facet.corners[i], facet.corners[(i + 1) % 3]})).facets.push_back(fresh);
  if (!facet.lists.empty()) whole_.push_back(fresh);
  facets_.push_back(std::move(facet));
  ++living_;
}

void BentSurface::add(const BentSegment& segment) {
  most_ = std::max(most_, segment.bent);
  const auto fresh = static_cast<Index>(segments_.size());
  const Side ends = ascending(Side(segment.ends));
  const auto [found, is_new] = segment_with_.try_emplace({ends, segment.origin}, fresh);
  if (!is_new && segments_[found->second].lives) {
    BentSegment& other = segments_[found->second];
    other.bent = std::max(other.bent, segment.bent);
    return;
  }
  found->second = fresh;
  segments_.push_back(segment);
  note(ends).segments.push_back(fresh);
}

bool BentSurface::had(const Triangle& corners) const {
  const auto found = facet_with_.find(ascending(corners));
  return found != facet_with_.end() && !facets_[found->second].lives;
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

BentSegment BentSurface::take_segment(Index segment, double more) {
  segments_[segment].lives = false;
  BentSegment taken = segments_[segment];
  taken.lives = true;
  taken.bent += more;
  return taken;
}

BentSurface::AtSide& BentSurface::note(const Side& side) {
  const auto [found, is_new] = at_side_.try_emplace(side);
  if (is_new) sides_.emplace(length(minus(vertices_[side[0]], vertices_[side[1]])), side);
  return found->second;
}

const BentSurface::AtSide* BentSurface::at(const Side& side) const {
  const auto found = at_side_.find(side);
  return found == at_side_.end() ? nullptr : &found->second;
}

std::optional<Side> BentSurface::next_side() {
  if (sides_.empty()) return std::nullopt;
  const auto last = std::prev(sides_.end());
  const Side side = last->second;
  sides_.erase(last);
  return side;
}

std::optional<Index> BentSurface::next_facet() {
  if (whole_.empty()) return std::nullopt;
  const Index f = whole_.back();
  whole_.pop_back();
  return f;
}

}  // namespace holdfast::repairing
