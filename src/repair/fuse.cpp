// Interfaces of parts that nearly coincide, cut alike.
//
// The vertices through which each side is routed are determined once (led_sides.h). From then on nothing is
// compared with a tolerance. The common triangulation of a plane patch is a constrained Delaunay
// triangulation with the pieces of all sides of all its parts, in two of the three coordinates, which are
// exact. Distances are computed in floating point: they determine what is joined, but an exact test decides
// afterwards whether the result is valid.
#include "repair/fuse.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "repair/cut_facet.h"
#include "repair/derived_facets.h"
#include "repair/led_sides.h"
#include "repair/part_facets.h"
#include "repair/patches.h"
#include "surface/places.h"

namespace holdfast::repairing {
namespace {

// Each place keeps one vertex, the first.
void name_places(State& state) {
  const std::vector<Index> first = first_at_places(state.vertices);
  const auto rename = [&](auto& entities) {
    for (auto& corners : entities)
      for (Index& v : corners)
        if (v < first.size() && first[v] != no_index) v = first[v];
  };
  rename(state.facets);
  rename(state.segments);
}

/// A facet in no patch, cut with its sides. A fan from a corner would fold where a side bends by more than a
/// triangle of the fan is wide.
std::vector<Triangle> cut_with_sides(const PartFacets& facets, const LedSides& sides, Index f,
                                     const Step& step) {
  const Triangle& corners = facets.corners(f);
  if (!facets.plane(f) || sides.round(corners).size() == corners.size()) return {corners};
  std::vector<Triangle> pieces;
  for (const Cell& cell : cut_facet(facets, sides, f, {}, {}, step))
    pieces.insert(pieces.end(), cell.triangles.begin(), cell.triangles.end());
  return pieces;
}

void deliver(const PartFacets& facets_of_parts, const LedSides& sides, const Patches& patches,
             const std::vector<Pasted>& pasted, const Step& step, State& state) {
  std::map<Index, std::vector<const Pasted*>> of_patch;  // by first facet
  for (const Pasted& p : pasted) of_patch[p.facets[0]].push_back(&p);
  DerivedFacets facets(state);
  for (Index f = 0; f < state.facets.size(); ++f) {
    if (patches.of[f] != no_index) {
      if (const auto own = of_patch.find(f); own != of_patch.end())
        for (const Pasted* p : own->second) facets.add(p->corners, p->facets);
      continue;
    }
    for (const Triangle& t : cut_with_sides(facets_of_parts, sides, f, step)) facets.add(t, std::array{f});
  }
  std::move(facets).move_to(state);
  state.doubt_all();
  drop_unused(state);
}

}  // namespace

double fuse(State& state, std::span<const Index> part, double gap, double rounding, const Step& step) {
  name_places(state);
  const PartFacets facets(state, part);
  const Patches patches = find_patches(facets, gap, rounding, step);
  if (patches.close.empty()) return 0;
  const LedSides sides(facets, patches.close, gap, state.vertices, step);
  double most = sides.most();
  const std::vector<Pasted> pasted = paste(facets, sides, patches, gap, rounding, step, most);
  deliver(facets, sides, patches, pasted, step, state);
  return most == 0 ? 0 : std::nextafter(2 * most * (1 + 0x1p-30), std::numeric_limits<double>::infinity());
}

}  // namespace holdfast::repairing
