// A surface under repair.
#include "repair/state.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "numbers/sorted.h"
#include "surface/complex.h"

namespace holdfast::repairing {

namespace {

bool is_identity(const Parents& parents) {
  if (parents.all.size() != parents.size()) return false;
  for (std::size_t i = 0; i < parents.size(); ++i)
    if (parents.first[i] != i || parents.all[i] != i) return false;
  return true;
}

}  // namespace

Parents identity(std::size_t count) {
  Parents parents;
  parents.all.resize(count);
  std::iota(parents.all.begin(), parents.all.end(), Index{0});
  parents.first.resize(count + 1);
  std::iota(parents.first.begin(), parents.first.end(), Index{0});
  return parents;
}

Parents composed(const Parents& before, Parents now) {
  if (is_identity(before)) return now;
  Parents parents;
  parents.first.reserve(now.first.size());
  parents.all.reserve(now.all.size());
  std::vector<Index> list;
  for (std::size_t i = 0; i < now.size(); ++i) {
    list.clear();
    for (const Index p : now.of(i)) list.insert(list.end(), before.of(p).begin(), before.of(p).end());
    sort_unique(list);
    parents.add(list);
  }
  return parents;
}

IndexLists lists_of(const Parents& parents) {
  IndexLists lists;
  lists.first.assign(parents.first.begin(), parents.first.end());
  lists.all = parents.all;
  return lists;
}

Box box_round(const State& state, std::span<const Index> corners, double margin) {
  Box box{state.vertices[corners[0]], state.vertices[corners[0]]};
  for (const Index v : corners) box.extend({state.vertices[v], state.vertices[v]});
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] -= margin;
    box.high[k] += margin;
  }
  return box;
}

std::vector<Index> drop_unused(State& state) {
  std::vector<Index> number(state.vertices.size(), no_index);
  for (Index v = 0; v < state.input_vertices; ++v) number[v] = v;
  const auto use = [&](const auto& entities) {
    for (const auto& corners : entities)
      for (const Index v : corners)
        if (number[v] == no_index) number[v] = 0;
  };
  use(state.facets);
  use(state.segments);
  auto next = static_cast<Index>(state.input_vertices);
  for (std::size_t v = state.input_vertices; v < number.size(); ++v) {
    if (number[v] == no_index) continue;
    state.vertices[next] = state.vertices[v];
    number[v] = next++;
  }
  state.vertices.resize(next);
  const auto renumber = [&](auto& entities) {
    for (auto& corners : entities)
      for (Index& v : corners) v = number[v];
  };
  renumber(state.facets);
  renumber(state.segments);
  return number;
}

KnownElements::KnownElements(const State& state, const Elements& elements) {
  if (!state.known.empty()) each_.reserve(elements.all.size());
  if (!state.sheet.empty()) sheet_.reserve(elements.all.size());
  for (const Element& e : elements.all) {
    if (!state.known.empty())
      each_.push_back(e.corners == 3 ? state.known[e.id] : e.corners == 1 && state.knows_vertices ? 1 : 0);
    if (!state.sheet.empty()) sheet_.push_back(e.corners == 3 ? state.sheet[e.id] : no_index);
  }
}

State state_of(const Complex& complex) {
  State state;
  state.input_vertices = complex.vertices.size();
  state.vertices.assign(complex.vertices.begin(), complex.vertices.end());
  state.facets.assign(complex.facets.begin(), complex.facets.end());
  state.segments.assign(complex.segments.begin(), complex.segments.end());
  state.facet_parents = identity(state.facets.size());
  state.segment_parents = identity(state.segments.size());
  return state;
}

arrange::Arrangement arrangement_of(const State& state, const Step& step, arrange::ArrangeOptions options) {
  const Complex complex = state.complex();
  const Elements elements = elements_of(complex, options.threads);
  const KnownElements known(state, elements);
  options.known = known.known();
  return arrange::arrange(complex, elements, step, options);
}

State arranged(const State& before, arrange::Arrangement arrangement) {
  State state;
  state.input_vertices = before.input_vertices;
  state.vertices.reserve(before.vertices.size() + arrangement.nearest.size());
  state.vertices = before.vertices;
  state.vertices.insert(state.vertices.end(), arrangement.nearest.begin(), arrangement.nearest.end());
  state.facets = std::move(arrangement.facets);
  state.segments = std::move(arrangement.segments);
  state.facet_parents = composed(before.facet_parents, std::move(arrangement.facet_parents));
  state.segment_parents = composed(before.segment_parents, std::move(arrangement.segment_parents));
  state.sheet = std::move(arrangement.facet_sheet);
  state.known.reserve(state.facets.size());
  const auto stands = [&](Index v) {
    return v < before.vertices.size() || arrangement.distances[v - before.vertices.size()] == 0;
  };
  for (const Triangle& t : state.facets)
    state.known.push_back(std::all_of(t.begin(), t.end(), stands) ? 1 : 0);
  drop_unused(state);
  return state;
}

}  // namespace holdfast::repairing
