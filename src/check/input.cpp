#include "check/input.h"

#include <algorithm>
#include <tuple>

#include "numbers/finite.h"

namespace holdfast::checking {

namespace {

std::vector<bool> used_vertices(const Complex& surface) {
  std::vector<bool> used(surface.vertices.size(), false);
  const auto use = [&](Index vertex) {
    if (vertex < used.size()) used[vertex] = true;
  };
  for (const Triangle& facet : surface.facets) std::for_each(facet.begin(), facet.end(), use);
  for (const Segment& segment : surface.segments) std::for_each(segment.begin(), segment.end(), use);
  return used;
}

/// For each vertex, the representative of its place, or `no_vertex`.
std::vector<Index> find_places(const Complex& surface, Pulse& pulse) {
  const std::vector<bool> used = used_vertices(surface);
  std::vector<Index> place(surface.vertices.size(), no_vertex);
  std::vector<Index> order;
  order.reserve(place.size());
  for (Index v = 0; v < place.size(); ++v)
    if (is_finite(surface.vertices[v]))
      order.push_back(v);
    else if (used[v])
      place[v] = v;
  // +0 and -0 are equal here.
  const auto key = [&](Index v) {
    const Point& p = surface.vertices[v];
    return std::tuple(p[0], p[1], p[2], !used[v], v);
  };
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    pulse();
    return key(a) < key(b);
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool repeats = i > 0 && surface.vertices[order[i]] == surface.vertices[order[i - 1]];
    if (!repeats)
      place[order[i]] = order[i];
    else if (used[order[i]])
      place[order[i]] = place[order[i - 1]];  // this vertex is used as well
  }
  return place;
}

}  // namespace

Input input_of(const Complex& surface, Pulse& pulse) {
  const std::vector<Index> place = find_places(surface, pulse);
  Input input;
  input.vertex.assign(place.size(), no_vertex);
  for (Index v = 0; v < place.size(); ++v)
    if (place[v] == v) {
      input.vertex[v] = static_cast<Index>(input.first.size());
      input.first.push_back(v);
    }
  for (Index v = 0; v < place.size(); ++v)
    if (place[v] != no_vertex) input.vertex[v] = input.vertex[place[v]];
  const auto in_mesh = [&](Index v) { return v < place.size() ? input.vertex[v] : no_vertex; };
  input.facets.reserve(surface.facets.size());
  for (const Triangle& f : surface.facets)
    input.facets.push_back({in_mesh(f[0]), in_mesh(f[1]), in_mesh(f[2])});
  input.segments.reserve(surface.segments.size());
  for (const Segment& s : surface.segments) input.segments.push_back({in_mesh(s[0]), in_mesh(s[1])});
  return input;
}

}  // namespace holdfast::checking
