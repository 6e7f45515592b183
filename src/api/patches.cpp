// Smooth patches of a surface: facets joined across nearly flat edges.
#include "holdfast/patches.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <set>
#include <stdexcept>

#include "holdfast/holdfast.h"
#include "mesh/disjoint_sets.h"
#include "numbers/elementary.h"
#include "numbers/sorted.h"
#include "numbers/vector.h"

namespace holdfast {
namespace {

struct SideOfFacet {
  Segment edge;  // ascending places
  Index facet = 0;
  bool forward = false;  // the facet goes from the lower to the higher place
  Segment ends{};        // the facet's own vertices
};

/// The unit normal, or nullopt if it cannot be computed in doubles.
std::optional<Vector> normal_of(const Surface& surface, const Triangle& t) {
  const Point& first = surface.vertices[t[0]];
  Vector n = cross(surface.vertices[t[1]] - first, surface.vertices[t[2]] - first);
  const double length = numbers::hypot(n[0], n[1], n[2]);
  if (!(length > 0) || length - length != 0) return std::nullopt;
  for (double& x : n) x /= length;
  return n;
}

/// The sides of the given facets, grouped by edge.
std::vector<SideOfFacet> sides_of(const Surface& surface, const std::vector<Index>& facets) {
  const std::vector<std::int64_t> place = vertex_map(surface.view());
  const auto place_of = [&](Index v) {
    if (v >= surface.vertices.size()) throw std::out_of_range("a facet names a vertex that does not exist");
    return place.empty() || place[v] < 0 ? v : static_cast<Index>(place[v]);
  };
  std::vector<SideOfFacet> sides;
  for (const Index f : facets)
    for (std::size_t k = 0; k < 3; ++k) {
      const Segment ends{surface.facets[f][k], surface.facets[f][(k + 1) % 3]};
      const Index a = place_of(ends[0]), b = place_of(ends[1]);
      sides.push_back({ascending(Segment{a, b}), f, a < b, ends});
    }
  std::sort(sides.begin(), sides.end(), [](const SideOfFacet& a, const SideOfFacet& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.facet < b.facet;
  });
  return sides;
}

class Patches {
 public:
  Patches(const Surface& surface, double degrees, const std::vector<Index>& facets)
      : surface_(surface),
        least_(numbers::cos(degrees * std::numbers::pi / 180)),
        sets_(surface.facets.size()) {
    const std::vector<SideOfFacet> sides = sides_of(surface, facets);  // this also checks the indices
    normals_.resize(surface.facets.size());
    for (const Index f : facets) normals_[f] = normal_of(surface, surface.facets[f]);
    for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
      for (j = i; j < sides.size() && sides[j].edge == sides[i].edge;) ++j;
      if (j == i + 2) meet(sides[i], sides[i + 1]);
    }
    for (const Index f : facets)
      if (!normals_[f] && neighbour_.contains(f)) sets_.unite(f, neighbour_.at(f).facet);
  }
  Index root(Index facet) { return sets_.root(facet); }

 private:
  struct Neighbour {
    double length = -1;
    Index facet = 0;
  };

  void meet(const SideOfFacet& a, const SideOfFacet& b) {
    if (!normals_[a.facet] || !normals_[b.facet]) {
      const double length = numbers::distance(surface_.vertices[a.ends[0]], surface_.vertices[a.ends[1]]);
      for (const auto& [from, to] : {std::pair(a.facet, b.facet), std::pair(b.facet, a.facet)})
        if (Neighbour& known = neighbour_[from]; length > known.length) known = {length, to};
      return;
    }
    // Facets with one orientation pass their common edge in opposite directions.
    const double turn = a.forward != b.forward ? 1 : -1;
    if (turn * dot(*normals_[a.facet], *normals_[b.facet]) > least_) sets_.unite(a.facet, b.facet);
  }

  const Surface& surface_;
  double least_;  // cosine of the largest angle
  DisjointSets sets_;
  std::vector<std::optional<Vector>> normals_;
  std::map<Index, Neighbour> neighbour_;  // of facets without a normal: across the longest edge
};

}  // namespace

std::size_t markers_by_angle(Surface& surface, double degrees) {
  if (!(degrees >= 0 && degrees <= 180))
    throw std::invalid_argument("the angle between patches must be from 0 to 180 degrees");
  surface.facet_markers.resize(surface.facets.size(), 0);
  std::vector<Index> facets;
  for (Index f = 0; f < surface.facets.size(); ++f)
    if (surface.facet_markers[f] == 0) facets.push_back(f);
  if (facets.empty()) return 0;
  Patches patches(surface, degrees, facets);
  std::set<int> used(surface.facet_markers.begin(), surface.facet_markers.end());
  std::map<Index, int> number;
  for (const Index f : facets) {
    const auto [there, fresh] = number.try_emplace(patches.root(f), 1);
    if (fresh) {
      while (used.contains(there->second)) ++there->second;
      used.insert(there->second);
    }
    surface.facet_markers[f] = there->second;
  }
  surface.names.facets.erase(0);
  return number.size();
}

}  // namespace holdfast
