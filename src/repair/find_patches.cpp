// Finds facets of different parts that lie on each other.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "mesh/disjoint_sets.h"
#include "numbers/elementary.h"
#include "repair/patches.h"
#include "surface/aabb_tree.h"

namespace holdfast::repairing {
namespace {

constexpr double kParallel = 0.9;  // cosine of an angle between facets of one patch

// Calls visit(f, g) for facets of different parts whose boxes come nearer than the gap.
template <class Visit>
void for_each_close(const PartFacets& facets, double gap, const Step& step, Visit&& visit) {
  std::vector<Box> boxes;
  std::vector<Index> ids;
  for (Index f = 0; f < facets.size(); ++f) {
    if (!facets.plane(f) || facets.is_shared(f)) continue;
    boxes.push_back(box_round(facets.state(), facets.corners(f), gap / 2));
    ids.push_back(f);
  }
  AabbTree(boxes).for_each_overlap(
      [&](Index i, Index j) {
        if (facets.part_of(ids[i]) != facets.part_of(ids[j])) visit(ids[i], ids[j]);
        return true;
      },
      [](Index, Index) { return false; }, step);
}

// Whether a corner of one facet comes within the gap of the other, or a side of one within the gap of a side
// of the other.
bool touch(const PartFacets& facets, const Triangle& f, const Triangle& g, double gap) {
  const auto at = [&](Index v) -> const Point& { return facets.at(v); };
  const auto near = [&](const Triangle& corners, const Triangle& t) {
    return std::any_of(corners.begin(), corners.end(),
                       [&](Index v) { return distance_to(at(v), at(t[0]), at(t[1]), at(t[2])) <= gap; });
  };
  if (near(f, g) || near(g, f)) return true;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (pass(at(f[i]), at(f[(i + 1) % 3]), at(g[j]), at(g[(j + 1) % 3])).distance <= gap) return true;
  return false;
}

// Whether no line along a side separates the facets or cuts off only a strip.
bool share_area(const PartFacets& facets, const Triangle& f, const Triangle& g, std::size_t axis,
                double rounding) {
  const auto extent = [&](const Triangle& t, const PlanePoint& n) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Index v : t) {
      const PlanePoint p = facets.flat(v, axis);
      const double x = p[0] * n[0] + p[1] * n[1];
      low = std::min(low, x);
      high = std::max(high, x);
    }
    return std::array{low, high};
  };
  for (const Triangle& t : {f, g})
    for (std::size_t i = 0; i < 3; ++i) {
      const PlanePoint p = facets.flat(t[i], axis), q = facets.flat(t[(i + 1) % 3], axis);
      const double long_pq = numbers::hypot(q[0] - p[0], q[1] - p[1]);
      if (!(long_pq > 0)) return false;
      const PlanePoint n{(p[1] - q[1]) / long_pq, (q[0] - p[0]) / long_pq};
      const auto a = extent(f, n), b = extent(g, n);
      if (!(std::min(a[1], b[1]) - std::max(a[0], b[0]) > rounding)) return false;
    }
  return true;
}

// Whether two facets nearly lie in one plane and share more area than rounding produces.
bool overlap(const PartFacets& facets, Index f, Index g, double gap, double rounding) {
  const PlaneOf &of_f = *facets.plane(f), &of_g = *facets.plane(g);
  if (std::fabs(dot(of_f.normal, of_g.normal)) < kParallel) return false;
  const Triangle &t = facets.corners(f), &u = facets.corners(g);
  const auto lies_in = [&](const Triangle& inner, const Triangle& outer, const PlaneOf& plane) {
    return std::all_of(inner.begin(), inner.end(), [&](Index v) {
      return std::fabs(dot(facets.at(v) - facets.at(outer[0]), plane.normal)) <= gap;
    });
  };
  const bool is_near = gap > rounding && touch(facets, t, u, gap);
  if (!lies_in(t, u, of_g) && !lies_in(u, t, of_f) && !is_near) return false;
  return share_area(facets, t, u, of_f.height >= of_g.height ? of_f.axis : of_g.axis, rounding);
}

}  // namespace

Patches find_patches(const PartFacets& facets, double gap, double rounding, const Step& step) {
  DisjointSets sets(facets.size());
  std::vector<std::uint8_t> is_close(facets.size(), 0);
  for_each_close(facets, gap, step, [&](Index f, Index g) {
    is_close[f] = is_close[g] = 1;
    if (overlap(facets, f, g, gap, rounding)) sets.unite(f, g);
  });
  Patches patches;
  std::map<Index, std::vector<Index>> with_root;
  for (Index f = 0; f < facets.size(); ++f) {
    if (is_close[f] == 0) continue;
    patches.close.push_back(f);
    with_root[sets.root(f)].push_back(f);
  }
  patches.of.assign(facets.size(), no_index);
  for (auto& [root, members] : with_root) {
    if (members.size() < 2) continue;
    for (const Index f : members) patches.of[f] = static_cast<Index>(patches.facets.size());
    patches.facets.push_back(std::move(members));
  }
  return patches;
}

}  // namespace holdfast::repairing
