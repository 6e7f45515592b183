// The places of a surface, and of the interfaces between its parts, by number.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "numbers/sorted.h"
#include "surface/places.h"
#include "surface/weld.h"

namespace holdfast::division {

/// Facets or segments by their corners, in any order of these.
template <std::size_t N>
class Finder {
 public:
  explicit Finder(const std::vector<std::array<Index, N>>& entities) {
    entries_.reserve(entities.size());
    for (std::size_t i = 0; i < entities.size(); ++i)
      entries_.push_back({ascending(entities[i]), static_cast<Index>(i)});
    std::sort(entries_.begin(), entries_.end());
  }
  /// `no_entity` where there is none.
  [[nodiscard]] Index find(const std::array<Index, N>& corners) const {
    const auto key = ascending(corners);
    const auto at = std::lower_bound(entries_.begin(), entries_.end(), key,
                                     [](const auto& entry, const auto& k) { return entry.first < k; });
    return at != entries_.end() && at->first == key ? at->second : no_entity;
  }

 private:
  std::vector<std::pair<std::array<Index, N>, Index>> entries_;
};

/// A surface with each place once, whose facets and segments are found by places.
struct SurfacePlaces {
  explicit SurfacePlaces(const Complex& complex)
      : merged(merge(complex, places_of(complex))),
        facet_markers(complex.facet_markers.begin(), complex.facet_markers.end()),
        segment_markers(complex.segment_markers.begin(), complex.segment_markers.end()),
        points(merged.vertices),
        welder(points, 2 * points.size()),
        facets(merged.facets),
        segments(merged.segments) {
    std::vector<Point> known;
    known.swap(points);
    for (const Point& p : known) welder.add(p);
  }
  SurfacePlaces(const SurfacePlaces&) = delete;
  SurfacePlaces& operator=(const SurfacePlaces&) = delete;

  [[nodiscard]] std::size_t count() const { return merged.vertices.size(); }

  Merged merged;
  std::vector<int> facet_markers, segment_markers;
  std::vector<Point> points;  ///< first those of the surface, then what was added
  Welder welder;              ///< of `points`
  Finder<3> facets;
  Finder<2> segments;
};

/// A face or segment in numbers of places; nothing where a corner has none.
template <std::size_t N>
[[nodiscard]] std::optional<std::array<Index, N>> in_places(const std::array<Index, N>& corners,
                                                            const std::vector<Point>& vertices,
                                                            const Welder& welder) {
  std::array<Index, N> places{};
  for (std::size_t k = 0; k < N; ++k) {
    places[k] = welder.find(vertices[corners[k]]);
    if (places[k] == no_entity) return std::nullopt;
  }
  return places;
}

/// What of a surface was in parts so far.
struct Seen {
  explicit Seen(const SurfacePlaces& places)
      : facets(places.merged.facets.size(), false),
        segments(places.merged.segments.size(), false),
        vertices(places.count(), false) {}

  void add(const Volume& part, const SurfacePlaces& places) {
    for (const Triangle& facet : part.facets)
      if (const auto corners = in_places(facet, part.vertices, places.welder))
        if (const Index f = places.facets.find(*corners); f != no_entity) facets[f] = true;
    for (const Segment& segment : part.segments)
      if (const auto ends = in_places(segment, part.vertices, places.welder))
        if (const Index s = places.segments.find(*ends); s != no_entity) segments[s] = true;
    for (const Point& p : part.vertices)
      if (const Index v = places.welder.find(p); v < vertices.size()) vertices[v] = true;
  }

  std::vector<bool> facets, segments, vertices;
};

}  // namespace holdfast::division
