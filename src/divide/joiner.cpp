// Joins parts to one volume: vertices at one place of the surface or of interfaces become one.
#include <stdexcept>

#include "divide/numbered_places.h"
#include "holdfast/divide.h"

namespace holdfast {

struct Joiner::State {
  State(const Complex& complex, int marker)
      : places(complex),
        interface_marker(marker),
        next(places.count()),
        numbers(places.count()),
        seen(places) {
    for (std::size_t v = 0; v < numbers.size(); ++v) numbers[v] = v;
    if (complex.names != nullptr) names = *complex.names;
  }

  /// Adds vertices of interfaces. Returns the place of each vertex of the part, if it has one.
  std::vector<Index> places_of_vertices(const Volume& part) {
    std::vector<bool> on_interface(part.vertices.size(), false);
    for (std::size_t f = 0; f < part.facets.size(); ++f)
      if (!part.facet_markers.empty() && part.facet_markers[f] == interface_marker)
        for (const Index v : part.facets[f]) on_interface[v] = true;
    std::vector<Index> result(part.vertices.size());
    for (std::size_t v = 0; v < result.size(); ++v)
      result[v] =
          on_interface[v] ? places.welder.add(part.vertices[v]) : places.welder.find(part.vertices[v]);
    return result;
  }

  division::SurfacePlaces places;
  int interface_marker;
  std::uint64_t next;                  // number of the next vertex
  std::vector<std::uint64_t> numbers;  // of places
  division::Seen seen;
  Names names;
};

Joiner::Joiner(const Complex& surface, int interface_marker)
    : state_(std::make_unique<State>(surface, interface_marker)) {}
Joiner::~Joiner() = default;
Joiner::Joiner(Joiner&&) noexcept = default;
Joiner& Joiner::operator=(Joiner&&) noexcept = default;

Joiner::Numbered Joiner::add(const Volume& part) {
  State& s = *state_;
  s.seen.add(part, s.places);
  Numbered numbered;
  numbered.vertices.resize(part.vertices.size());
  const std::vector<Index> places = s.places_of_vertices(part);
  for (std::size_t v = 0; v < places.size(); ++v) {
    if (places[v] != no_entity && places[v] < s.numbers.size()) {
      numbered.vertices[v] = s.numbers[places[v]];
      continue;
    }
    // Places are added in the order of their vertices.
    if (places[v] != no_entity) s.numbers.push_back(s.next);
    numbered.vertices[v] = s.next++;
    numbered.fresh.push_back(static_cast<Index>(v));
  }
  return numbered;
}

std::uint64_t Joiner::vertices() const { return state_->next; }

Volume Joiner::surface() const {
  const State& s = *state_;
  Volume volume;
  const Merged& merged = s.places.merged;
  volume.vertices = merged.vertices;
  volume.vertex_markers = merged.vertex_markers;
  volume.input_vertices.assign(merged.first.begin(), merged.first.end());
  volume.names = s.names;
  for (std::size_t f = 0; f < merged.facets.size(); ++f) {
    if (!s.seen.facets[f]) continue;
    volume.facets.push_back(merged.facets[f]);
    if (!s.places.facet_markers.empty()) volume.facet_markers.push_back(s.places.facet_markers[f]);
  }
  for (std::size_t i = 0; i < merged.segments.size(); ++i) {
    if (!s.seen.segments[i]) continue;
    volume.segments.push_back(merged.segments[i]);
    if (!s.places.segment_markers.empty()) volume.segment_markers.push_back(s.places.segment_markers[i]);
  }
  return volume;
}

Volume join_parts(const Complex& surface, std::span<const Volume> parts, int interface_marker) {
  Joiner joiner(surface, interface_marker);
  Volume joined;
  std::vector<Point> fresh;
  for (const Volume& part : parts) {
    const Joiner::Numbered numbered = joiner.add(part);
    if (joiner.vertices() >= no_entity)
      throw std::length_error("the parts have more vertices together than 32 bits can number");
    for (const Index v : numbered.fresh) fresh.push_back(part.vertices[v]);
    for (std::size_t t = 0; t < part.tetrahedra.size(); ++t) {
      Tetrahedron corners{};
      for (std::size_t k = 0; k < 4; ++k)
        corners[k] = static_cast<Index>(numbered.vertices[part.tetrahedra[t][k]]);
      joined.tetrahedra.push_back(corners);
      joined.regions.push_back(part.regions.empty() ? 0 : part.regions[t]);
    }
  }
  Volume common = joiner.surface();
  common.tetrahedra = std::move(joined.tetrahedra);
  common.regions = std::move(joined.regions);
  common.vertices.insert(common.vertices.end(), fresh.begin(), fresh.end());
  common.input_vertices.resize(common.vertices.size(), -1);
  if (!common.vertex_markers.empty()) common.vertex_markers.resize(common.vertices.size(), 0);
  return common;
}

}  // namespace holdfast
