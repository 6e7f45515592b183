// Second-order nodes in a format's order, and the tetrahedra at facets.
#include "io/mesh_sets.h"

#include <algorithm>

#include "numbers/sorted.h"

namespace holdfast::io {
namespace {

struct FacetKey {
  Triangle key;  // sorted corners
  Index facet;
};

/// Whether a face is an even permutation of a facet with the same corners.
bool same_orientation(const Triangle& a, const Triangle& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a[0] == b[k]) return a[1] == b[(k + 1) % 3];
  return false;
}

}  // namespace

Nodes tetrahedron_nodes(const Volume& volume, std::size_t i, const EdgeOrder& order) {
  Nodes nodes;
  for (const Index corner : volume.tetrahedra[i]) nodes.of[nodes.count++] = corner;
  if (is_second_order(volume))
    for (const std::size_t edge : order) nodes.of[nodes.count++] = volume.mid_nodes.tetrahedra[i][edge];
  return nodes;
}

Nodes facet_nodes(const Volume& volume, std::size_t i) {
  Nodes nodes;
  for (const Index corner : volume.facets[i]) nodes.of[nodes.count++] = corner;
  if (is_second_order(volume))
    for (const Index mid : volume.mid_nodes.facets[i]) nodes.of[nodes.count++] = mid;
  return nodes;
}

Nodes segment_nodes(const Volume& volume, std::size_t i) {
  Nodes nodes;
  for (const Index end : volume.segments[i]) nodes.of[nodes.count++] = end;
  if (is_second_order(volume)) nodes.of[nodes.count++] = volume.mid_nodes.segments[i];
  return nodes;
}

std::vector<SidesOfFacet> sides_of_facets(const Volume& volume) {
  std::vector<FacetKey> keys;
  keys.reserve(volume.facets.size());
  for (std::size_t f = 0; f < volume.facets.size(); ++f)
    keys.push_back({ascending(volume.facets[f]), static_cast<Index>(f)});
  std::sort(keys.begin(), keys.end(), [](const FacetKey& a, const FacetKey& b) {
    return a.key != b.key ? a.key < b.key : a.facet < b.facet;
  });
  std::vector<SidesOfFacet> sides(volume.facets.size());
  for (Index t = 0; t < volume.tetrahedra.size(); ++t) {
    const Tetrahedron& corners = volume.tetrahedra[t];
    for (std::uint8_t side = 0; side < 4; ++side) {
      const Triangle face = outward_face(corners, side);
      const Triangle key = ascending(face);
      auto found = std::lower_bound(keys.begin(), keys.end(), key,
                                    [](const FacetKey& a, const Triangle& b) { return a.key < b; });
      for (; found != keys.end() && found->key == key; ++found) {
        SidesOfFacet& of = sides[found->facet];
        (same_orientation(volume.facets[found->facet], face) ? of.behind : of.front) = SideOfTet{t, side};
      }
    }
  }
  return sides;
}

}  // namespace holdfast::io
