// Surface layer: vertices with identical coordinates are one vertex.
#include "surface/places.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "holdfast/holdfast.h"
#include "numbers/finite.h"
#include "surface/weld.h"

namespace holdfast {
namespace {

std::vector<std::uint8_t> used_vertices(const Complex& complex) {
  std::vector<std::uint8_t> used(complex.vertices.size(), 0);
  const auto mark = [&](const auto& entities) {
    for (const auto& corners : entities)
      for (const Index v : corners)
        if (v < used.size()) used[v] = 1;
  };
  mark(complex.facets);
  mark(complex.segments);
  return used;
}

}  // namespace

std::vector<Index> first_at_places(std::span<const Point> vertices) {
  std::vector<Index> first(vertices.size());
  std::iota(first.begin(), first.end(), Index{0});
  PlaceTable table(vertices.size());
  const auto point_of = [&](Index v) -> const Point& { return vertices[v]; };
  // Each batch is announced before its first entry is looked up.
  constexpr std::size_t kBatch = 16;
  std::array<std::uint64_t, kBatch> hashes;
  for (std::size_t begin = 0; begin < vertices.size(); begin += kBatch) {
    const std::size_t end = std::min(vertices.size(), begin + kBatch);
    for (std::size_t v = begin; v < end; ++v) hashes[v - begin] = table.announce(vertices[v]);
    for (std::size_t v = begin; v < end; ++v)
      if (is_finite(vertices[v]))
        first[v] = table.find_or_add(vertices[v], hashes[v - begin], static_cast<Index>(v), point_of);
  }
  return first;
}

Places places_of(const Complex& complex) {
  Places places;
  places.first = first_at_places(complex.vertices);
  bool suspect = false;
  for (Index v = 0; v < places.first.size() && !suspect; ++v)
    suspect = places.first[v] != v || !is_finite(complex.vertices[v]);
  if (!suspect) return places;

  const std::vector<std::uint8_t> used = used_vertices(complex);
  // Indexed by the first of all vertices at a place: the first one that is used.
  std::vector<Index> first_used(places.first.size(), no_index);
  for (Index v = 0; v < places.first.size(); ++v)
    if (Index& at = first_used[places.first[v]]; used[v] != 0 && at == no_index) at = v;
  for (Index v = 0; v < places.first.size(); ++v) {
    Index& first = places.first[v];
    const Index in_use = first_used[first];
    if (used[v] != 0) {
      first = in_use;
      if (first != v) ++places.merged;
    } else if (first != v || in_use != no_index || !is_finite(complex.vertices[v])) {
      first = no_index;
      ++places.left_out;
    }
  }
  return places;
}

std::vector<Index> index_of(const Places& places) {
  std::vector<Index> index(places.first.size(), no_index);
  Index next = 0;
  // The first vertex at a place comes before the others.
  for (Index v = 0; v < index.size(); ++v) {
    const Index first = places.first[v];
    if (first != no_index) index[v] = first == v ? next++ : index[first];
  }
  return index;
}

std::vector<std::int64_t> as_map(std::span<const Index> index) {
  std::vector<std::int64_t> map(index.size());
  std::transform(index.begin(), index.end(), map.begin(),
                 [](Index v) { return v == no_index ? std::int64_t{-1} : std::int64_t{v}; });
  return map;
}

Merged merge(const Complex& complex, const Places& places) {
  Merged merged;
  merged.index = index_of(places);
  for (Index v = 0; v < complex.vertices.size(); ++v) {
    if (places.first[v] != v) continue;
    merged.vertices.push_back(complex.vertices[v]);
    merged.first.push_back(v);
  }
  if (complex.vertex_markers.size() == complex.vertices.size()) {
    merged.vertex_markers.assign(merged.vertices.size(), 0);
    for (Index v = 0; v < merged.index.size(); ++v) {
      if (merged.index[v] == no_index) continue;
      int& marker = merged.vertex_markers[merged.index[v]];
      if (marker == 0) marker = complex.vertex_markers[v];
    }
  }
  merged.facets.assign(complex.facets.begin(), complex.facets.end());
  for (Triangle& facet : merged.facets)
    for (Index& v : facet) v = merged.index[v];
  merged.segments.assign(complex.segments.begin(), complex.segments.end());
  for (Segment& segment : merged.segments)
    for (Index& v : segment) v = merged.index[v];
  return merged;
}

std::vector<std::int64_t> vertex_map(const Complex& complex) {
  const Places places = places_of(complex);
  if (places.all_distinct()) return {};
  return as_map(index_of(places));
}

std::vector<double> merged_sizes(const Merged& merged, std::span<const double> sizes) {
  std::vector<double> least(merged.vertices.size(), 0);
  for (std::size_t v = 0; v < sizes.size(); ++v) {
    if (merged.index[v] == no_index || !(sizes[v] > 0)) continue;
    double& at = least[merged.index[v]];
    if (at == 0 || sizes[v] < at) at = sizes[v];
  }
  return least;
}

}  // namespace holdfast
