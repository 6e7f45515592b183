#include "repair/grid.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "repair/near.h"
#include "surface/complex.h"

namespace holdfast::repairing {
namespace {

Point nearest_on_grid(const Point& p, double cell) {
  Point q{};
  for (std::size_t k = 0; k < 3; ++k) q[k] = std::nearbyint(p[k] / cell) * cell;
  return q;
}

/// The grid points to which the corners of elements in trouble move.
std::set<Point> taken_by(const State& state, const Trouble& trouble, double cell) {
  std::set<Point> taken;
  const auto take = [&](const auto& corners) {
    for (const Index v : corners)
      if (v < state.vertices.size() && is_finite(state.vertices[v]))
        taken.insert(nearest_on_grid(state.vertices[v], cell));
  };
  for (const Index f : trouble.facets) take(state.facets[f]);
  for (const Index s : trouble.segments) take(state.segments[s]);
  return taken;
}

/// For each vertex, whether a facet or segment uses it.
std::vector<std::uint8_t> used_in(const State& state) {
  std::vector<std::uint8_t> used(state.vertices.size(), 0);
  const auto use = [&](const auto& entities) {
    for (const auto& corners : entities)
      for (const Index v : corners)
        if (v < used.size()) used[v] = 1;
  };
  use(state.facets);
  use(state.segments);
  return used;
}

}  // namespace

double snap_to_grid(State& state, const Trouble& trouble, double cell) {
  const std::set<Point> taken = taken_by(state, trouble, cell);
  const std::vector<std::uint8_t> used = used_in(state);
  std::map<Point, Point> goes;
  std::map<Point, Index> first_at;
  std::map<Index, Index> becomes;  // for vertices that moved or are not the first at their place
  double most = 0;
  for (Index v = 0; v < used.size(); ++v) {
    Point& p = state.vertices[v];
    if (used[v] == 0 || !is_finite(p)) continue;
    const Point q = nearest_on_grid(p, cell);
    if (!taken.contains(q)) continue;
    const Index first = first_at.try_emplace(q, v).first->second;
    if (p == q && first == v) continue;
    becomes[v] = first;
    goes.emplace(p, q);
    most = std::max(most, length(p - q) * (1 + 0x1p-48));
    p = q;
  }
  // Vertices that were joined with one of these earlier keep their place.
  for (Index v = 0; v < state.input_vertices; ++v)
    if (used[v] == 0 && is_finite(state.vertices[v]))
      if (const auto found = goes.find(state.vertices[v]); found != goes.end())
        state.vertices[v] = found->second;
  const auto rename = [&](auto& entities, const auto& renamed) {
    for (std::size_t i = 0; i < entities.size(); ++i)
      for (Index& v : entities[i])
        if (const auto found = becomes.find(v); found != becomes.end()) {
          v = found->second;
          renamed(i);
        }
  };
  rename(state.facets, [&](std::size_t f) { state.doubt(f); });
  rename(state.segments, [](std::size_t) {});
  drop_unused(state);
  return most;
}

}  // namespace holdfast::repairing
