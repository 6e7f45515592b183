// Closes holes.
#include "repair/holes.h"

#include <algorithm>
#include <map>
#include <optional>
#include <ranges>
#include <set>

#include "exact/predicates.h"
#include "mesh/disjoint_sets.h"
#include "numbers/sorted.h"
#include "plane/least_area.h"
#include "plane/triangulate.h"
#include "repair/borders.h"
#include "surface/complex.h"
#include "surface/intersect.h"

namespace holdfast::repairing {
namespace {

/// A coordinate axis that is not parallel to the loop's plane, if the loop is plane.
std::optional<unsigned> plane_axis(const State& state, const Loop& loop) {
  const auto at = [&](Index v) { return state.vertices[v].data(); };
  Simplex t;
  t.corners = 3;
  for (std::size_t i = 2; i < loop.size(); ++i) {
    t.point = {at(loop[0]), at(loop[1]), at(loop[i])};
    if (!set_projection(t)) continue;
    const bool plane = std::all_of(loop.begin(), loop.end(), [&](Index v) {
      return exact::orient3d(t.point[0], t.point[1], t.point[2], at(v)) == 0;
    });
    if (plane) return t.axis;
    return std::nullopt;
  }
  return std::nullopt;
}

/// Orients the facets so that their border runs as the loop does.
void turn_alike(std::vector<Triangle>& facets, const Loop& loop) {
  std::set<Segment> sides;
  for (std::size_t i = 0; i < loop.size(); ++i) sides.insert({loop[i], loop[(i + 1) % loop.size()]});
  for (const Triangle& t : facets)
    for (std::size_t i = 0; i < 3; ++i) {
      if (sides.count({t[i], t[(i + 1) % 3]}) != 0) return;
      if (sides.count({t[(i + 1) % 3], t[i]}) == 0) continue;
      for (Triangle& turned : facets) std::swap(turned[1], turned[2]);
      return;
    }
}

std::vector<Triangle> fill_plane(const State& state, const Loop& loop, unsigned axis, const Step& step) {
  std::vector<PlanePoint> points;
  std::vector<Segment> segments;
  for (Index i = 0; i < loop.size(); ++i) {
    const Point& p = state.vertices[loop[i]];
    points.push_back({p[(axis + 1) % 3], p[(axis + 2) % 3]});
    segments.push_back({i, static_cast<Index>((i + 1) % loop.size())});
  }
  Plane plane;
  plane.points = points;
  plane.segments = segments;
  PlaneOptions options;
  options.delaunay = true;
  const PlaneResult result = plane::triangulate(plane, options, step);
  if (result.outcome != Outcome::done) return {};
  std::vector<Triangle> facets = result.mesh.triangles;
  for (Triangle& t : facets) t = {loop[t[0]], loop[t[1]], loop[t[2]]};
  turn_alike(facets, loop);
  return facets;
}

/// A triangulation of the loop with the least total area.
std::vector<Triangle> fill_least(const State& state, const Loop& loop, const Step& step) {
  std::vector<Point> places;
  places.reserve(loop.size());
  for (const Index v : loop) places.push_back(state.vertices[v]);
  std::vector<Triangle> facets;
  for (const auto& t : plane::triangles_of_least_area(places, step))
    facets.push_back({loop[t[0]], loop[t[1]], loop[t[2]]});
  return facets;
}

struct Filling {
  Loop loop;
  std::vector<Triangle> facets;
  bool is_plane;
};

std::optional<Filling> filling_of(const State& state, const Loop& loop, const Step& step) {
  const std::optional<unsigned> axis = plane_axis(state, loop);
  std::vector<Triangle> facets;
  if (axis)
    facets = fill_plane(state, loop, *axis, step);
  else
    facets = fill_least(state, loop, step);
  if (facets.empty()) return std::nullopt;
  return Filling{loop, std::move(facets), axis.has_value()};
}

/// Fillings that do not fit together with the surface or with an earlier filling.
std::set<std::size_t> unfit(const State& state, std::size_t before,
                            const std::vector<std::size_t>& filling_with, const Step& step,
                            const Threads& threads) {
  const Complex complex = state.complex();
  const Elements elements = elements_of(complex, threads);
  std::vector<std::uint8_t> known;
  for (const Element& e : elements.all) known.push_back(e.corners == 3 && e.id >= before ? 0 : 1);
  std::set<std::size_t> found;
  for (const Flaw& flaw : elements.flaws)
    if (flaw.corners == 3 && flaw.id >= before) found.insert(filling_with[flaw.id - before]);
  const VisitPair visit = [&](Index i, Index j, const Contacts&) {
    std::size_t last = 0;
    bool any = false;
    for (const Index k : {i, j}) {
      const Element& e = elements.all[k];
      if (e.corners != 3 || e.id < before) continue;
      last = std::max(last, filling_with[e.id - before]);
      any = true;
    }
    if (any) found.insert(last);
    return true;
  };
  for_each_offending_pair(complex, elements, visit, step, {}, known);
  return found;
}

/// Fills each hole by itself. Those that stay open are noted in `holes`.
std::vector<Filling> fillings_of(const State& state, std::size_t most_sides, const Step& step, Holes& holes) {
  std::vector<Filling> fillings;
  for (Loop& loop : border_loops(state.complex())) {
    step(0.9);
    if (loop.size() > most_sides) {
      holes.left_open.push_back({std::move(loop), OpenReason::too_many_sides});
    } else if (std::optional<Filling> filling = filling_of(state, loop, step)) {
      fillings.push_back(std::move(*filling));
    } else {
      holes.left_open.push_back({std::move(loop), OpenReason::no_filling});
    }
  }
  return fillings;
}

/// Adds the facets of fillings to the surface, and leaves out fillings until the rest fits together.
void add_fitting(State& state, std::vector<Filling>& fillings, const Step& step, const Threads& threads,
                 Holes& holes) {
  const std::size_t before = state.facets.size();
  for (;;) {
    std::vector<std::size_t> filling_with;
    state.facets.resize(before);
    for (std::size_t k = 0; k < fillings.size(); ++k)
      for (const Triangle& t : fillings[k].facets) {
        state.facets.push_back(t);
        filling_with.push_back(k);
      }
    const std::set<std::size_t> bad = unfit(state, before, filling_with, step, threads);
    if (bad.empty()) return;
    for (const std::size_t k : std::ranges::reverse_view(bad)) {
      holes.left_open.push_back({std::move(fillings[k].loop), OpenReason::meets_surface});
      fillings.erase(fillings.begin() + static_cast<std::ptrdiff_t>(k));
    }
  }
}

/// Facets grouped in parts that are connected by sides.
std::vector<std::vector<Index>> connected_parts(const State& state, std::span<const Index> facets) {
  DisjointSets sets(facets.size());
  std::map<Segment, Index> with_side;
  for (Index k = 0; k < facets.size(); ++k) {
    const Triangle& t = state.facets[facets[k]];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(t[i], t[(i + 1) % 3]);
      sets.unite(k, with_side.try_emplace({a, b}, k).first->second);
    }
  }
  std::map<Index, std::vector<Index>> parts;
  for (Index k = 0; k < facets.size(); ++k) parts[sets.root(k)].push_back(facets[k]);
  std::vector<std::vector<Index>> list;
  list.reserve(parts.size());
  for (auto& [unused, part] : parts) list.push_back(std::move(part));
  return list;
}

/// The first border loop of some facets, found among their own vertices: they are few of the surface's.
Loop border_of(const State& state, std::span<const Index> facets) {
  std::vector<Index> own;
  for (const Index f : facets) own.insert(own.end(), state.facets[f].begin(), state.facets[f].end());
  sort_unique(own);
  std::vector<Triangle> triangles;
  triangles.reserve(facets.size());
  for (const Index f : facets) {
    Triangle t = state.facets[f];
    for (Index& v : t) v = static_cast<Index>(std::lower_bound(own.begin(), own.end(), v) - own.begin());
    triangles.push_back(t);
  }
  std::vector<Point> points;
  points.reserve(own.size());
  for (const Index v : own) points.push_back(state.vertices[v]);
  Loop loop = std::move(border_loops(Complex{points, triangles, {}, {}, {}}).at(0));
  for (Index& v : loop) v = own[v];
  return loop;
}

std::vector<Index> numbers_of(std::span<const Index> of, std::span<const Index> number) {
  std::vector<Index> numbers;
  for (const Index i : of)
    if (number[i] != no_index) numbers.push_back(number[i]);
  return numbers;
}

}  // namespace

Holes fill_holes(State& state, std::size_t most_sides, const Step& step, const Threads& threads) {
  Holes holes;
  std::vector<Filling> fillings = fillings_of(state, most_sides, step, holes);
  const std::size_t before = state.facets.size();
  add_fitting(state, fillings, step, threads, holes);
  auto next = static_cast<Index>(before);
  for (const Filling& filling : fillings) {
    RepairResult::Filled& entry = holes.filled.emplace_back();
    entry.border = filling.loop;
    entry.is_plane = filling.is_plane;
    for (std::size_t k = 0; k < filling.facets.size(); ++k) {
      entry.facets.push_back(next++);
      state.facet_parents.add({});
    }
  }
  return holes;
}

void renumber(Holes& holes, const State& state, std::span<const Index> facet_number,
              std::span<const Index> vertex_number) {
  std::vector<RepairResult::Filled> left;
  for (const auto& [border, facets, is_plane] : holes.filled) {
    std::vector<Index> kept = numbers_of(facets, facet_number);
    if (kept.size() == facets.size()) {
      left.push_back({numbers_of(border, vertex_number), std::move(kept), is_plane});
      continue;
    }
    for (std::vector<Index>& part : connected_parts(state, kept)) {
      Loop border = border_of(state, part);
      left.push_back({std::move(border), std::move(part), is_plane});
    }
  }
  holes.filled = std::move(left);
  for (RepairResult::LeftOpen& hole : holes.left_open) {
    std::vector<Index> border = numbers_of(hole.border, vertex_number);
    if (border.size() < hole.border.size()) border.clear();
    hole.border = std::move(border);
  }
}

}  // namespace holdfast::repairing
