// Interfaces of parts that nearly coincide, cut alike.
//
// What each side is led through is decided once for all facets that have it, so that no crack can open: a
// vertex of another part lies on at most one side of a part, and two sides cross in one vertex. From then on
// nothing is compared with a tolerance. The common triangulation of a plane patch is a constrained Delaunay
// triangulation with the pieces of all sides of all its parts, in two of the three coordinates, which are
// exact. Distances are computed in floating point: they choose what is joined, never whether the result is
// valid, which an exact test tells afterwards.
#include "repair/fuse.h"

#include <algorithm>
#include <limits>
#include <map>

#include "mesh/disjoint_sets.h"
#include "numbers/elementary.h"
#include "numbers/sorted.h"
#include "repair/fusing.h"
#include "surface/places.h"

namespace holdfast::repairing {
namespace {

constexpr double kParallel = 0.9;  // cosine of an angle between facets of one patch
constexpr double kFlat = 8;        // of what rounding makes: how thick a plane patch may be

}  // namespace

double Fusing::run() {
  name_places();
  list_facets();
  find_patches();
  if (close_.empty()) return 0;
  list_sides();
  put_vertices_on_sides();
  cross_sides();
  for (auto& [side, on] : sides_) std::sort(on.points.begin(), on.points.end());
  for (auto& [side, on] : sides_) part_from_itself(side, on);
  triangulate_patches();
  deliver();
  return most_ == 0 ? 0 : std::nextafter(2 * most_ * (1 + 0x1p-30), std::numeric_limits<double>::infinity());
}

void Fusing::name_places() {
  const std::vector<Index> first = first_at_places(state_.vertices);
  const auto rename = [&](auto& entities) {
    for (auto& corners : entities)
      for (Index& v : corners)
        if (v < first.size() && first[v] != no_index) v = first[v];
  };
  rename(state_.facets);
  rename(state_.segments);
}

void Fusing::list_facets() {
  planes_.resize(state_.facets.size());
  parts_at_.resize(state_.vertices.size());
  for (Index f = 0; f < state_.facets.size(); ++f) {
    planes_[f] = plane_of(state_.facets[f]);
    if (!planes_[f]) continue;
    for (const Index v : state_.facets[f])
      for (const Index p : state_.facet_parents.of(f)) parts_at_[v].push_back(part_[p]);
  }
  for (std::vector<Index>& parts : parts_at_) sort_unique(parts);
}

std::optional<Fusing::PlaneOf> Fusing::plane_of(const Triangle& t) const {
  for (const Index v : t)
    if (v >= state_.vertices.size() || !is_finite(at(v))) return std::nullopt;
  const Vector u = minus(at(t[1]), at(t[0])), v = minus(at(t[2]), at(t[0])), w = minus(at(t[2]), at(t[1]));
  const double longest = std::max({length(u), length(v), length(w)});
  if (!(longest > 0) || !std::isfinite(longest)) return std::nullopt;
  Vector n = cross(over(u, longest), over(v, longest));
  const double twice_area = length(n);
  if (!(twice_area > 0x1p-40)) return std::nullopt;
  PlaneOf plane{over(n, twice_area), twice_area * longest, 0};
  for (std::size_t k = 1; k < 3; ++k)
    if (std::fabs(plane.normal[k]) > std::fabs(plane.normal[plane.axis])) plane.axis = k;
  return plane;
}

template <class Visit>
void Fusing::for_each_close(Visit&& visit) const {
  std::vector<Box> boxes;
  std::vector<Index> ids;
  for (Index f = 0; f < state_.facets.size(); ++f) {
    if (!planes_[f] || is_shared(f)) continue;
    boxes.push_back(box_round(state_, state_.facets[f], gap_ / 2));
    ids.push_back(f);
  }
  AabbTree(boxes).for_each_overlap(
      [&](Index i, Index j) {
        if (part_of(ids[i]) != part_of(ids[j])) visit(ids[i], ids[j]);
        return true;
      },
      [](Index, Index) { return false; }, step_);
}

void Fusing::find_patches() {
  DisjointSets sets(state_.facets.size());
  std::vector<std::uint8_t> is_close(state_.facets.size(), 0);
  for_each_close([&](Index f, Index g) {
    is_close[f] = is_close[g] = 1;
    if (overlap(f, g)) sets.unite(f, g);
  });
  std::map<Index, std::vector<Index>> patches;
  for (Index f = 0; f < state_.facets.size(); ++f) {
    if (is_close[f] != 0) close_.push_back(f);
    if (is_close[f] != 0) patches[sets.root(f)].push_back(f);
  }
  patch_of_.assign(state_.facets.size(), no_index);
  for (auto& [root, facets] : patches) {
    if (facets.size() < 2) continue;
    for (const Index f : facets) patch_of_[f] = static_cast<Index>(patches_.size());
    patches_.push_back(std::move(facets));
  }
}

double Fusing::above(Index v, const Point& origin, const Vector& normal) const {
  return std::fabs(dot(minus(at(v), origin), normal));
}

bool Fusing::overlap(Index f, Index g) const {
  if (std::fabs(dot(planes_[f]->normal, planes_[g]->normal)) < kParallel) return false;
  const auto lies_in = [&](Index inner, Index outer) {
    const Point& origin = at(state_.facets[outer][0]);
    const auto& t = state_.facets[inner];
    return std::all_of(t.begin(), t.end(),
                       [&](Index v) { return above(v, origin, planes_[outer]->normal) <= gap_; });
  };
  const bool is_near = gap_ > rounding_ && touch(state_.facets[f], state_.facets[g]);
  if (!lies_in(f, g) && !lies_in(g, f) && !is_near) return false;
  const Index wide = planes_[f]->height >= planes_[g]->height ? f : g;
  return share_area(state_.facets[f], state_.facets[g], planes_[wide]->axis);
}

bool Fusing::touch(const Triangle& f, const Triangle& g) const {
  const auto near = [&](const Triangle& corners, const Triangle& t) {
    return std::any_of(corners.begin(), corners.end(),
                       [&](Index v) { return distance_to(at(v), at(t[0]), at(t[1]), at(t[2])) <= gap_; });
  };
  if (near(f, g) || near(g, f)) return true;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (pass(at(f[i]), at(f[(i + 1) % 3]), at(g[j]), at(g[(j + 1) % 3])).distance <= gap_) return true;
  return false;
}

PlanePoint Fusing::flat(Index v, std::size_t axis) const {
  return {at(v)[(axis + 1) % 3], at(v)[(axis + 2) % 3]};
}

bool Fusing::share_area(const Triangle& f, const Triangle& g, std::size_t axis) const {
  const auto extent = [&](const Triangle& t, const PlanePoint& n) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Index v : t) {
      const PlanePoint p = flat(v, axis);
      const double x = p[0] * n[0] + p[1] * n[1];
      low = std::min(low, x);
      high = std::max(high, x);
    }
    return std::array{low, high};
  };
  for (const Triangle& t : {f, g})
    for (std::size_t i = 0; i < 3; ++i) {
      const PlanePoint p = flat(t[i], axis), q = flat(t[(i + 1) % 3], axis);
      const double long_pq = numbers::hypot(q[0] - p[0], q[1] - p[1]);
      if (!(long_pq > 0)) return false;
      const PlanePoint n{(p[1] - q[1]) / long_pq, (q[0] - p[0]) / long_pq};
      const auto a = extent(f, n), b = extent(g, n);
      if (!(std::min(a[1], b[1]) - std::max(a[0], b[0]) > rounding_)) return false;
    }
  return true;
}

bool Fusing::is_flat(const std::vector<Index>& facets) const {
  const PlaneOf& plane = *planes_[widest(facets)];
  const Point& origin = at(state_.facets[widest(facets)][0]);
  return std::all_of(facets.begin(), facets.end(), [&](Index f) {
    const auto& t = state_.facets[f];
    return std::all_of(t.begin(), t.end(),
                       [&](Index v) { return above(v, origin, plane.normal) <= kFlat * rounding_; });
  });
}

Index Fusing::widest(const std::vector<Index>& facets) const {
  return *std::max_element(facets.begin(), facets.end(), [&](Index f, Index g) {
    return planes_[f]->height != planes_[g]->height ? planes_[f]->height < planes_[g]->height : f > g;
  });
}

bool Fusing::split(const Triangle& t, std::vector<Triangle>& pieces, int depth) const {
  constexpr int kDeepest = 24;  // each level is done with a side
  if (depth > kDeepest) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Index a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
    const std::vector<Index> along = chain(a, b);
    if (along.size() == 2) continue;
    for (std::size_t k = 0; k + 1 < along.size(); ++k)
      if (along[k] != c && along[k + 1] != c && !split({along[k], along[k + 1], c}, pieces, depth + 1))
        return false;
    return true;
  }
  pieces.push_back(t);
  return true;
}

void Fusing::deliver() {
  std::map<Index, std::vector<const Pasted*>> of_patch;  // by first facet
  for (const Pasted& p : pasted_) of_patch[p.facets[0]].push_back(&p);
  std::vector<Triangle> facets, pieces;
  Parents parents;
  std::vector<Index> list;
  const auto take = [&](const Triangle& t, std::span<const Index> of) {
    facets.push_back(t);
    list.clear();
    for (const Index f : of) {
      const auto own = state_.facet_parents.of(f);
      list.insert(list.end(), own.begin(), own.end());
    }
    sort_unique(list);
    parents.add(list);
  };
  for (Index f = 0; f < state_.facets.size(); ++f) {
    if (patch_of_[f] != no_index) {
      if (const auto own = of_patch.find(f); own != of_patch.end())
        for (const Pasted* p : own->second) take(p->corners, p->facets);
      continue;
    }
    pieces.clear();
    if (!planes_[f] || !split(state_.facets[f], pieces)) pieces.assign(1, state_.facets[f]);
    for (const Triangle& t : pieces) take(t, std::array{f});
  }
  state_.facets = std::move(facets);
  state_.facet_parents = std::move(parents);
  state_.known.clear();
  drop_unused(state_);
}

double fuse(State& state, std::span<const Index> part, double gap, double rounding, const Step& step) {
  return Fusing(state, part, gap, rounding, step).run();
}

}  // namespace holdfast::repairing
