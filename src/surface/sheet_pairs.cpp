// Surface layer: pairs of facets of different sheets that may meet.
#include "surface/sheet_pairs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "numbers/release.h"
#include "numbers/vector.h"
#include "surface/complex.h"

namespace holdfast {
namespace {

constexpr std::size_t kMostVisits = 64;  // of pairs of sheets, per element
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The largest coordinate.
double size_of(const Point& p) { return std::max({std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])}); }

/// A normal of a triangle, twice its area long; not finite if that overflows.
Point normal_of(const Point& a, const Point& b, const Point& c) { return cross(b - a, c - a); }

/// Whether a fan of one part surely shares only its vertex with facets there that are this flat.
bool is_steep(double rise, double slope, double layer, double share) {
  return rise > 2 * layer && slope > share;
}

}  // namespace

SheetPairs::SheetPairs(const Complex& complex, const Elements& elements, std::span<const Index> sheet,
                       std::span<const std::uint8_t> known, std::size_t block)
    : complex_(complex), elements_(elements) {
  divide(sheet, known);
  number_blocks(block);
  list_pairs(sheet.size());
  if (!too_many_) list_batches();
}

void SheetPairs::number_blocks(std::size_t block) {
  std::size_t facets = 0;
  for (Part& part : parts_) {
    part.block = facets / block;
    facets += part.facets.size();
  }
  if (facets > 2 * block) return;  // then two blocks, which would be prepared together anyway, are one
  for (Part& part : parts_) part.block = 0;
}

void SheetPairs::list_batches() {
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const auto [p, q] = pairs_[k];
    const std::array<std::size_t, 2> blocks{parts_[p].block, parts_[q].block};
    if (batches_.empty() || batches_.back().blocks != blocks) batches_.push_back({k, k, blocks});
    batches_.back().last = k + 1;
  }
}

void SheetPairs::prepare(const Batch& batch, const Threads& threads) {
  const auto is_asked = [&](const Part& part) {
    return std::find(batch.blocks.begin(), batch.blocks.end(), part.block) != batch.blocks.end();
  };
  for (Part& part : parts_)
    if (part.is_prepared && !is_asked(part)) forget(part);
  parallel_ranges(threads, parts_.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p)
      if (!parts_[p].is_prepared && is_asked(parts_[p])) measure(parts_[p]);
  });
}

void SheetPairs::forget(Part& part) {
  part.is_prepared = false;
  part.tree = {};
  release(part.corners);
  release(part.vertices);
}

void SheetPairs::list_pairs(std::size_t most) {
  if (parts_.empty()) return;
  std::vector<Box> boxes;
  for (const Part& part : parts_) boxes.push_back(part.box);
  Box all = boxes[0];
  for (const Box& box : boxes) all.extend(box);
  const std::vector<Round> round = rounds(all);
  std::size_t visited = 0;
  AabbTree(boxes).for_each_overlap(
      [&](Index p, Index q) {
        const Part &a = parts_[p], &b = parts_[q];
        if (a.sheet == b.sheet || (a.is_known && b.is_known)) return true;
        ++visited;
        if (!surely_apart(round[p].triangle, round[q].triangle) && !surely_apart(round[p].box, round[q].box))
          pairs_.push_back({std::min(p, q), std::max(p, q)});
        too_many_ = pairs_.size() > most || visited > kMostVisits * most;
        return !too_many_;
      },
      [](Index, Index) { return false; }, [](double) {});
  std::sort(pairs_.begin(), pairs_.end(), [&](const auto& a, const auto& b) {
    const auto blocks = [&](const std::array<Index, 2>& pair) {
      return std::pair(parts_[pair[0]].block, parts_[pair[1]].block);
    };
    return std::pair(blocks(a), a) < std::pair(blocks(b), b);
  });
}

/// In the frame of a box round all.
std::vector<SheetPairs::Round> SheetPairs::rounds(const Box& all) const {
  const UnitFrame frame(all);
  std::vector<Round> rounds;
  rounds.reserve(parts_.size());
  std::vector<std::array<Point, 3>> corners;
  for (const Part& part : parts_) {
    corners.clear();
    for (const Index e : part.facets) {
      const auto at = [&](std::size_t i) {
        return frame(complex_.vertices[elements_.all[e].vertex[i]].data());
      };
      corners.push_back({at(0), at(1), at(2)});
    }
    rounds.push_back({oriented_box(corners), RoundTriangle(corners)});
  }
  return rounds;
}

void SheetPairs::divide(std::span<const Index> sheet, std::span<const std::uint8_t> known) {
  std::vector<std::tuple<Index, bool, Index>> all;
  for (Index e = 0; e < sheet.size(); ++e)
    if (sheet[e] != no_index) all.emplace_back(sheet[e], is_round_origin(elements_.all[e].vertex), e);
  std::sort(all.begin(), all.end());
  for (const auto& [s, is_round, e] : all) {
    if (parts_.empty() || parts_.back().sheet != s || parts_.back().is_round_origin != is_round) {
      parts_.emplace_back();
      parts_.back().sheet = s;
      parts_.back().is_round_origin = is_round;
      parts_.back().is_known = !known.empty();
      const Point& corner = complex_.vertices[elements_.all[e].vertex[0]];
      parts_.back().box = {corner, corner};
    }
    parts_.back().facets.push_back(e);
    for (const Index v : elements_.all[e].vertex)
      parts_.back().box.extend({complex_.vertices[v], complex_.vertices[v]});
    if (!known.empty() && known[e] == 0) parts_.back().is_known = false;
  }
}

/// Whether no coordinate has the same sign at all corners and is at least a quarter of the corner's size at
/// each.
bool SheetPairs::is_round_origin(const Triangle& facet) const {
  for (std::size_t k = 0; k < 3; ++k) {
    unsigned positive = 0, negative = 0;
    for (const Index v : facet) {
      const Point& p = complex_.vertices[v];
      const double quarter = size_of(p) / 4;
      positive += p[k] >= quarter && p[k] > 0;
      negative += -p[k] >= quarter && p[k] < 0;
    }
    if (positive == 3 || negative == 3) return false;
  }
  return true;
}

void SheetPairs::measure(Part& part) const {
  part.is_prepared = true;
  part.most = part.most_share = 0;
  std::vector<Box> boxes;
  boxes.reserve(part.facets.size());
  double largest = 0, least = kInfinity;
  for (const Index e : part.facets) {
    const auto at = [&](std::size_t i) -> const Point& {
      return complex_.vertices[elements_.all[e].vertex[i]];
    };
    boxes.push_back({at(0), at(0)});
    for (std::size_t i = 1; i < 3; ++i) boxes.back().extend({at(i), at(i)});
    const Point normal = normal_of(at(0), at(1), at(2));
    const double area = size_of(normal);
    if (!(area > largest) || area == kInfinity) continue;
    largest = area;
    part.normal = normal;
  }
  part.tree = AabbTree(boxes);
  part.corners.reserve(part.facets.size());
  part.vertices.reserve(part.facets.size());
  for (const AabbTree::Item& item : part.tree.items(0)) {
    const Triangle& corners = elements_.all[part.facets[item.id]].vertex;
    part.corners.push_back(
        {complex_.vertices[corners[0]], complex_.vertices[corners[1]], complex_.vertices[corners[2]]});
    part.vertices.push_back(corners);
  }
  // Components of at most 1/8, so that products do not overflow.
  for (double& x : part.normal) x = largest > 0 ? x / largest / 8 : 0;
  for (const Index e : part.facets)
    for (const Index v : elements_.all[e].vertex)
      if (const double size = size_of(complex_.vertices[v]); size < least) {
        least = size;
        part.offset = dot(part.normal, complex_.vertices[v]);
      }
  // Three roundings of products and three of sums err by at most 2^-51 (|x| + |d|), and by less than 2^-1070
  // where something is denormal.
  constexpr double kShare = 0x1p-50, kDenormal = 0x1p-1070;
  const double least_error = kShare * std::fabs(part.offset) + kDenormal;
  for (const Index e : part.facets)
    for (const Index v : elements_.all[e].vertex) {
      const Point& p = complex_.vertices[v];
      const double size = size_of(p);
      const double h = std::fabs(dot(part.normal, p) - part.offset) + kShare * size + least_error;
      if (part.is_round_origin)
        part.most = std::max(part.most, h);
      else
        part.most_share = std::max(part.most_share, h / size);
    }
  // With room for the rounding errors of these numbers, and of the points compared with them.
  part.most = part.most * (1 + 0x1p-40) + least_error;
  part.most_share = 4 * part.most_share * (1 + 0x1p-40) + kShare;
}

/// The flatness of a facet of a part, seen from a corner. As squares: 64 (t / r)^2, where 16 are needed,
/// leaves room for rounding errors where the area is not only rounding; and sums of these are not so small
/// that they underflow.
SheetPairs::Flatness SheetPairs::flatness(const Part& part, const std::array<Point, 3>& corners,
                                          std::size_t corner) {
  const Point &v = corners[corner], &p = corners[(corner + 1) % 3], &q = corners[(corner + 2) % 3];
  const double size = std::max({size_of(v), size_of(p), size_of(q)});
  const double t = part.most + part.most_share * size;
  const Point a = p - v, b = q - v, n = cross(a, b), side = q - p;
  const double area = dot(n, n), most_area = dot(a, a) * dot(b, b);
  constexpr double kLeastShare = 0x1p-80, kLeast = 0x1p-400;
  const bool is_known = area > kLeastShare * most_area && area > kLeast && t > kLeast;
  return {t, is_known ? 64 * (t * t) * dot(side, side) / area : kInfinity};
}

/// False if the facet does not touch the plane of the other part.
bool SheetPairs::find_near(const Part& part, std::size_t item, const Part& plane, Near& near) {
  const std::array<Point, 3>& corners = part.corners[item];
  std::array<double, 3> h{};
  double most = 0;  // of the bounds
  unsigned above = 0, below = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    h[i] = dot(plane.normal, corners[i]) - plane.offset;
    const double bound = plane.most + plane.most_share * size_of(corners[i]);
    above |= static_cast<unsigned>(h[i] > bound) << i;
    below |= static_cast<unsigned>(h[i] < -bound) << i;
    h[i] = std::fabs(h[i]) - bound;
    most = std::max(most, bound);
  }
  if (above == 7 || below == 7) return false;
  near.vertex = no_index;
  const unsigned beyond = above | below;
  if (beyond == 0 || (above != 0 && below != 0)) return true;
  // The part of the facet near the plane is that near to the corners near the plane: h <= 4 most there, by
  // linearity.
  double rise = kInfinity, far = 0;
  Point low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  for (std::size_t i = 0; i < 3; ++i) {
    if ((beyond >> i & 1u) != 0) {
      rise = std::min(rise, h[i]);
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], corners[i][k]);
      high[k] = std::max(high[k], corners[i][k]);
    }
    for (std::size_t j = 0; j < 3; ++j) {
      if ((beyond >> j & 1u) == 0) continue;
      const Point way = corners[j] - corners[i];
      far = std::max(far, dot(way, way));
    }
  }
  const double room = 5 * most / rise * std::sqrt(far);
  for (std::size_t k = 0; k < 3; ++k) {
    near.box.low[k] = std::max(near.box.low[k], low[k] - room);
    near.box.high[k] = std::min(near.box.high[k], high[k] + room);
  }
  const unsigned touching = 7u & ~beyond;
  if ((touching & (touching - 1)) != 0) return true;
  const auto corner = static_cast<std::size_t>(std::countr_zero(touching));
  near.vertex = part.vertices[item][corner];
  near.rise = rise;
  near.slope = rise * rise / far;
  near.flatness = flatness(part, corners, corner);
  return true;
}

/// Whether a box is beyond the plane of a part.
bool SheetPairs::is_beyond(const Box& box, const Part& plane) {
  const Point& n = plane.normal;
  Point least{}, most{}, far{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double low = n[k] * box.low[k], high = n[k] * box.high[k];
    least[k] = std::min(low, high);
    most[k] = std::max(low, high);
    far[k] = std::max(std::fabs(box.low[k]), std::fabs(box.high[k]));
  }
  const double bound = plane.most + plane.most_share * size_of(far);
  return least[0] + least[1] + least[2] - plane.offset > bound ||
         most[0] + most[1] + most[2] - plane.offset < -bound;
}

/// The facets of a part that touch the plane of another part within a box.
SheetPairs::Touching SheetPairs::touching(const Part& part, const Part& plane, const Box& box) {
  const AabbTree::Item* const first = part.tree.items(0).data();
  Touching found;
  std::vector<Near> fanned;
  part.tree.for_each_item([&](const Box& node) { return !node.overlaps(box) || is_beyond(node, plane); },
                          [&](const AabbTree::Item& item) {
                            Near near{item.box, part.facets[item.id], no_index};
                            if (!find_near(part, static_cast<std::size_t>(&item - first), plane, near))
                              return;
                            if (near.vertex != no_index) {
                              fanned.push_back(near);
                              return;
                            }
                            const auto at = static_cast<Index>(found.elements.size());
                            found.elements.push_back(near.element);
                            found.fans.push_back({near.box, at, at + 1, no_index, 0, 0, {}});
                          });
  std::sort(fanned.begin(), fanned.end(), [](const Near& p, const Near& q) {
    return std::tie(p.vertex, p.element) < std::tie(q.vertex, q.element);
  });
  for (const Near& near : fanned) {
    const auto at = static_cast<Index>(found.elements.size());
    found.elements.push_back(near.element);
    if (found.fans.empty() || found.fans.back().vertex != near.vertex) {
      found.fans.push_back({near.box, at, at + 1, near.vertex, near.rise, near.slope, near.flatness});
      continue;
    }
    Fan& fan = found.fans.back();
    fan.last = at + 1;
    fan.box.extend(near.box);
    fan.rise = std::min(fan.rise, near.rise);
    fan.slope = std::min(fan.slope, near.slope);
    fan.flatness.layer = std::max(fan.flatness.layer, near.flatness.layer);
    fan.flatness.share = std::max(fan.flatness.share, near.flatness.share);
  }
  return found;
}

/// Compares the facets of two parts that touch each other's planes.
class SheetPairs::Sweep {
 public:
  Sweep(const SheetPairs& sheets, const Part& a, const Part& b, const Visit& visit)
      : sheets_(sheets), a_(a), b_(b), visit_(visit) {}

  /// False: stopped.
  bool run() {
    if (is_beyond(b_.box, a_)) return true;
    of_a_ = touching(a_, b_, b_.box);
    if (of_a_.fans.empty()) return true;
    Box box = of_a_.fans[0].box;
    for (const Fan& fan : of_a_.fans) box.extend(fan.box);
    of_b_ = touching(b_, a_, box);
    if (of_b_.fans.empty()) return true;
    sort(box);
    for (auto i = of_a_.fans.begin(), j = of_b_.fans.begin();
         i != of_a_.fans.end() && j != of_b_.fans.end();) {
      const bool is_a = i->box.low[axis_] <= j->box.low[axis_];
      if (is_a ? !overlapping(*i, j, of_b_.fans.end(),
                              [&](const Fan& p, const Fan& q) { return compare(p, q); })
               : !overlapping(*j, i, of_a_.fans.end(),
                              [&](const Fan& p, const Fan& q) { return compare(q, p); }))
        return false;
      is_a ? ++i : ++j;
    }
    return true;
  }

 private:
  /// Sorts along the longest axis of the box of the first part's facets.
  void sort(const Box& box) {
    for (std::size_t k = 1; k < 3; ++k)
      if (box.high[k] / 2 - box.low[k] / 2 > box.high[axis_] / 2 - box.low[axis_] / 2) axis_ = k;
    const auto before = [this](const Fan& p, const Fan& q) {
      return std::tie(p.box.low[axis_], p.first) < std::tie(q.box.low[axis_], q.first);
    };
    std::sort(of_a_.fans.begin(), of_a_.fans.end(), before);
    std::sort(of_b_.fans.begin(), of_b_.fans.end(), before);
  }

  template <class From, class Pair>
  bool overlapping(const Fan& fan, From from, From end, Pair&& pair) const {
    for (; from != end && from->box.low[axis_] <= fan.box.high[axis_]; ++from)
      if (fan.box.overlaps(from->box) && !pair(fan, *from)) return false;
    return true;
  }

  bool compare(const Fan& p, const Fan& q) const {
    if (is_apart(p, b_, of_b_, q) || is_apart(q, a_, of_a_, p)) return true;
    for (Index i = p.first; i < p.last; ++i)
      for (Index j = q.first; j < q.last; ++j)
        if (!visit_(of_a_.elements[i], of_b_.elements[j])) return false;
    return true;
  }

  /// Whether a fan surely shares only its vertex with the facets of another fan, of `part`.
  [[nodiscard]] bool is_apart(const Fan& fan, const Part& part, const Touching& of_part,
                              const Fan& other) const {
    if (fan.vertex == no_index) return false;
    if (other.vertex == fan.vertex)
      return is_steep(fan.rise, fan.slope, other.flatness.layer, other.flatness.share);
    if (other.vertex != no_index) return false;
    const Triangle& t = sheets_.elements_.all[of_part.elements[other.first]].vertex;
    for (std::size_t i = 0; i < 3; ++i) {
      if (t[i] != fan.vertex) continue;
      const auto at = [&](std::size_t k) { return sheets_.complex_.vertices[t[k]]; };
      const Flatness flat = flatness(part, {at(0), at(1), at(2)}, i);
      return is_steep(fan.rise, fan.slope, flat.layer, flat.share);
    }
    return false;
  }

  const SheetPairs& sheets_;
  const Part &a_, &b_;
  const Visit& visit_;
  std::size_t axis_ = 0;
  Touching of_a_, of_b_;
};

bool SheetPairs::for_each(const std::array<Index, 2>& parts, const Visit& visit) const {
  return Sweep(*this, parts_[parts[0]], parts_[parts[1]], visit).run();
}

}  // namespace holdfast
