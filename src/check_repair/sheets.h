// Check of repairs: which parts of a surface may meet.
//
// The parts that a repair makes of an input triangle lie near a plane. Two such sheets can only meet near the
// line of their planes, but the boxes of their parts overlap all over the sheets. For 150 pages of a book
// that cross in its spine, with 150 parts each, boxes overlap 100 million times.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "check/box_tree.h"
#include "holdfast/types.h"

namespace holdfast::checking {

/// A facet, segment or isolated vertex, by vertices that stand for places.
struct Part {
  std::array<Index, 3> corners;
  std::size_t size;
  std::size_t id;
  [[nodiscard]] std::span<const Index> span() const { return std::span(corners).first(size); }
};

/// Calls `visit` once for each pair of parts that have a point in common, and for others. All corners must be
/// finite. Parts are taken for a sheet if they have the same number, which may be missing; a wrong one costs
/// time only.
void for_each_near_pair(std::span<const Point> vertices, std::span<const Part> parts,
                        std::span<const Index> sheet, const std::function<void(Index, Index)>& visit);

}  // namespace holdfast::checking
