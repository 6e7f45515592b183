// Surface layer: pairs of facets of different sheets that may meet.
#include "surface/sheet_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "surface/complex.h"

namespace holdfast {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double product(const Point& n, const Point& p) { return n[0] * p[0] + n[1] * p[1] + n[2] * p[2]; }

/// Across a triangle and twice its area long; not finite where that overflows.
Point normal_of(const Point& a, const Point& b, const Point& c) {
  Point u{}, v{};
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = b[k] - a[k];
    v[k] = c[k] - a[k];
  }
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// The largest coordinate.
double size_of(const Point& p) { return std::max({std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])}); }

bool visit_each(std::vector<AabbTree::Item>& a, std::vector<AabbTree::Item>& b,
                const SheetPairs::Visit& visit) {
  // Along the axis in which these reach furthest.
  Box box = a[0].box;
  for (const AabbTree::Item& item : a) box.extend(item.box);
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (box.high[k] / 2 - box.low[k] / 2 > box.high[axis] / 2 - box.low[axis] / 2) axis = k;
  const auto before = [axis](const AabbTree::Item& p, const AabbTree::Item& q) {
    return std::tie(p.box.low[axis], p.id) < std::tie(q.box.low[axis], q.id);
  };
  std::sort(a.begin(), a.end(), before);
  std::sort(b.begin(), b.end(), before);
  const auto overlapping = [&](const AabbTree::Item& item, auto from, auto end, auto&& pair) {
    for (; from != end && from->box.low[axis] <= item.box.high[axis]; ++from)
      if (item.box.overlaps(from->box) && !pair(item.id, from->id)) return false;
    return true;
  };
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
    if (i->box.low[axis] <= j->box.low[axis]) {
      if (!overlapping(*i++, j, b.end(), visit)) return false;
    } else {
      if (!overlapping(*j++, i, a.end(), [&](Index p, Index q) { return visit(q, p); })) return false;
    }
  }
  return true;
}

}  // namespace

SheetPairs::SheetPairs(const Complex& complex, const Elements& elements, std::span<const Index> sheet,
                       std::span<const std::uint8_t> known, const Threads& threads)
    : complex_(complex), elements_(elements) {
  divide(sheet, known);
  list_pairs(sheet.size());
  if (too_many_) return;
  parallel_ranges(threads, parts_.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p) measure(parts_[p]);
  });
}

void SheetPairs::list_pairs(std::size_t most) {
  std::vector<Box> boxes;
  for (const Part& part : parts_) boxes.push_back(part.box);
  AabbTree(boxes).for_each_overlap(
      [&](Index p, Index q) {
        const Part &a = parts_[p], &b = parts_[q];
        if (a.sheet != b.sheet && !(a.is_known && b.is_known))
          pairs_.push_back({std::min(p, q), std::max(p, q)});
        too_many_ = pairs_.size() > most;
        return !too_many_;
      },
      [](Index, Index) { return false; }, [](double) {});
  std::sort(pairs_.begin(), pairs_.end());
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

/// Whether no coordinate of all corners has one sign and is at least a quarter of their size.
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
  std::vector<Box> boxes;
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
  for (const AabbTree::Item& item : part.tree.items(0)) {
    const Triangle& corners = elements_.all[part.facets[item.id]].vertex;
    part.corners.push_back(
        {complex_.vertices[corners[0]], complex_.vertices[corners[1]], complex_.vertices[corners[2]]});
  }
  // Components of at most 1/8, so that products do not overflow.
  for (double& x : part.normal) x = largest > 0 ? x / largest / 8 : 0;
  for (const Index e : part.facets)
    for (const Index v : elements_.all[e].vertex)
      if (const double size = size_of(complex_.vertices[v]); size < least) {
        least = size;
        part.offset = product(part.normal, complex_.vertices[v]);
      }
  // Three roundings of products and three of sums err by 2^-51 (|x| + |d|) at most, and where something is
  // denormal by less than 2^-1070.
  constexpr double kShare = 0x1p-50, kDenormal = 0x1p-1070;
  const double least_error = kShare * std::fabs(part.offset) + kDenormal;
  for (const Index e : part.facets)
    for (const Index v : elements_.all[e].vertex) {
      const Point& p = complex_.vertices[v];
      const double size = size_of(p);
      const double h = std::fabs(product(part.normal, p) - part.offset) + kShare * size + least_error;
      if (part.is_round_origin)
        part.most = std::max(part.most, h);
      else
        part.most_share = std::max(part.most_share, h / size);
    }
  // With room for the roundings of these numbers, and for those of the points that are compared with them.
  part.most = part.most * (1 + 0x1p-40) + least_error;
  part.most_share = 4 * part.most_share * (1 + 0x1p-40) + kShare;
}

/// The facets of a part that touch the plane and the box of another one.
SheetPairs::Items SheetPairs::touching(const Part& part, const Part& plane) const {
  const Box& box = plane.box;
  const Point& n = plane.normal;
  const AabbTree::Item* const first = part.tree.items(0).data();
  Items found;
  part.tree.for_each_item(
      [&](const Box& node) {
        if (!node.overlaps(box)) return true;
        Point least{}, most{}, far{};
        for (std::size_t k = 0; k < 3; ++k) {
          const double low = n[k] * node.low[k], high = n[k] * node.high[k];
          least[k] = std::min(low, high);
          most[k] = std::max(low, high);
          far[k] = std::max(std::fabs(node.low[k]), std::fabs(node.high[k]));
        }
        const double bound = plane.most + plane.most_share * size_of(far);
        return least[0] + least[1] + least[2] - plane.offset > bound ||
               most[0] + most[1] + most[2] - plane.offset < -bound;
      },
      [&](const AabbTree::Item& item) {
        unsigned above = 0, below = 0;
        for (const Point& corner : part.corners[static_cast<std::size_t>(&item - first)]) {
          const double h = product(n, corner) - plane.offset;
          const double bound = plane.most + plane.most_share * size_of(corner);
          above += static_cast<unsigned>(h > bound);
          below += static_cast<unsigned>(h < -bound);
        }
        if (above < 3 && below < 3) found.push_back({item.box, part.facets[item.id]});
      });
  return found;
}

bool SheetPairs::for_each(const std::array<Index, 2>& parts, const Visit& visit) const {
  const Part &a = parts_[parts[0]], &b = parts_[parts[1]];
  Items of_a = touching(a, b);
  if (of_a.empty()) return true;
  Items of_b = touching(b, a);
  return of_b.empty() || visit_each(of_a, of_b, visit);
}

}  // namespace holdfast
