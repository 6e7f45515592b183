#include "divide/seeds.h"

#include <algorithm>
#include <map>

#include "divide/centre.h"
#include "exact/predicates.h"
#include "numbers/vector.h"

namespace holdfast::division {
namespace {

bool is_inside(const Volume& volume, const Tetrahedron& t, const Point& p) {
  for (std::size_t k = 0; k < 4; ++k) {
    std::array<const double*, 4> corners{};
    for (std::size_t i = 0; i < 4; ++i) corners[i] = i == k ? p.data() : volume.vertices[t[i]].data();
    if (exact::orient3d(corners[0], corners[1], corners[2], corners[3]) <= 0) return false;
  }
  return true;
}

/// An estimate for a tetrahedron: larger if its centre is further from the surface.
double room(const Volume& volume, const Tetrahedron& t) {
  const Point& a = volume.vertices[t[0]];
  const Vector u = volume.vertices[t[1]] - a, v = volume.vertices[t[2]] - a, w = volume.vertices[t[3]] - a;
  const double area =
      length(cross(u, v)) + length(cross(v, w)) + length(cross(w, u)) + length(cross(v - u, w - u));
  return area > 0 ? dot(cross(u, v), w) / area : 0;
}

/// For each region of the filled surface, its roomiest place.
std::map<int, Point> places_in(const Volume& volume) {
  std::map<int, Point> places;
  std::map<int, double> best;
  for (std::size_t t = 0; t < volume.tetrahedra.size(); ++t) {
    const double here = room(volume, volume.tetrahedra[t]);
    const auto known = best.find(volume.regions[t]);
    if (known != best.end() && here <= known->second) continue;
    const Point p = centre(volume, volume.tetrahedra[t]);
    if (!is_inside(volume, volume.tetrahedra[t], p)) continue;
    best[volume.regions[t]] = here;
    places[volume.regions[t]] = p;
  }
  return places;
}

double size_of_region(std::span<const RegionSeed> wanted, int id, double size) {
  for (const RegionSeed& seed : wanted)
    if (seed.id == id && seed.size > 0) size = size > 0 ? std::min(size, seed.size) : seed.size;
  return size;
}

/// For each region of the filled surface, the region of the part there.
std::map<int, std::optional<int>> contents(const Result& filled, const std::vector<FacetRegions>& sides) {
  std::map<int, std::optional<int>> content;
  for (std::size_t f = 0; f < sides.size(); ++f)
    for (std::size_t side = 0; side < 2; ++side)
      if (const auto region = filled.facet_regions[f][side]) content[*region] = sides[f][side];
  return content;
}

}  // namespace

Outcome add_seeds(CutSurface& surface, std::span<const RegionSeed> wanted, double size,
                  const Options& options) {
  Surface& s = surface.part.surface;
  const Result filled = mesh(s.view(), options);
  if (filled.outcome != Outcome::done) return filled.outcome;
  const std::map<int, Point> places = places_in(filled.volume);
  for (const auto& [region, content] : contents(filled, surface.sides)) {
    const auto place = places.find(region);
    if (place == places.end()) return Outcome::not_representable;
    if (content)
      s.regions.push_back({place->second, *content, size_of_region(wanted, *content, size)});
    else
      s.holes.push_back(place->second);
  }
  return Outcome::done;
}

}  // namespace holdfast::division
