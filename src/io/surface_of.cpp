// The surface of a volume, without inner vertices, to be meshed again.
#include <algorithm>
#include <array>
#include <stdexcept>

#include "holdfast/io.h"
#include "io/indices.h"
#include "numbers/sorted.h"

namespace holdfast {
namespace {

struct FaceOfTet {
  Triangle key;  // sorted corners
  Index tet = 0;
  std::uint8_t side = 0;
};

Triangle corners(const Volume& volume, const FaceOfTet& face) {
  return outward_face(volume.tetrahedra[face.tet], face.side);
}

// Faces with one tetrahedron, or with two in different regions; the latter oriented as in the first one.
std::vector<FaceOfTet> bounding_faces(const Volume& volume) {
  std::vector<FaceOfTet> all;
  all.reserve(4 * volume.tetrahedra.size());
  for (Index t = 0; t < volume.tetrahedra.size(); ++t)
    for (std::uint8_t i = 0; i < 4; ++i) {
      all.push_back({{}, t, i});
      all.back().key = ascending(corners(volume, all.back()));
    }
  std::sort(all.begin(), all.end(), [](const FaceOfTet& a, const FaceOfTet& b) {
    return a.key != b.key ? a.key < b.key : a.tet < b.tet;
  });
  const auto region = [&](const FaceOfTet& f) { return volume.regions.empty() ? 0 : volume.regions[f.tet]; };
  std::vector<FaceOfTet> bounding;
  for (std::size_t i = 0, j = 0; i < all.size(); i = j) {
    bool differ = false;
    for (j = i; j < all.size() && all[j].key == all[i].key; ++j)
      differ = differ || region(all[j]) != region(all[i]);
    if (j == i + 1 || differ) bounding.push_back(all[i]);
  }
  return bounding;
}

// Drops the vertices without a facet or segment.
void drop_unused_vertices(Surface& surface) {
  std::vector<bool> used(surface.vertices.size());
  for (const Triangle& t : surface.facets)
    for (const Index v : t) used[v] = true;
  for (const Segment& s : surface.segments)
    for (const Index v : s) used[v] = true;
  std::vector<Index> number(used.size());
  Index next = 0;
  for (Index v = 0; v < used.size(); ++v) {
    number[v] = next;
    if (!used[v]) continue;
    if (!surface.vertex_markers.empty()) surface.vertex_markers[next] = surface.vertex_markers[v];
    surface.vertices[next++] = surface.vertices[v];
  }
  surface.vertices.resize(next);
  if (!surface.vertex_markers.empty()) surface.vertex_markers.resize(next);
  for (Triangle& t : surface.facets)
    for (Index& v : t) v = number[v];
  for (Segment& s : surface.segments)
    for (Index& v : s) v = number[v];
}

}  // namespace

Surface surface_of(const Volume& volume) {
  if (!volume.regions.empty() && volume.regions.size() != volume.tetrahedra.size())
    throw std::invalid_argument("as many regions as tetrahedra are needed, or none");
  io::require_indices(volume);
  Surface surface;
  surface.vertices = volume.vertices;
  surface.facets = volume.facets;
  surface.facet_markers = volume.facet_markers;
  surface.segments = volume.segments;
  surface.segment_markers = volume.segment_markers;
  surface.vertex_markers = volume.vertex_markers;
  surface.names = volume.names;
  surface.names.regions.clear();  // `mesh` numbers regions anew
  std::vector<Triangle> listed;
  for (const Triangle& t : volume.facets) listed.push_back(ascending(t));
  std::sort(listed.begin(), listed.end());
  std::vector<FaceOfTet> bounding = bounding_faces(volume);
  std::sort(bounding.begin(), bounding.end(), [](const FaceOfTet& a, const FaceOfTet& b) {
    return a.tet != b.tet ? a.tet < b.tet : a.side < b.side;
  });
  for (const FaceOfTet& face : bounding)
    if (!std::binary_search(listed.begin(), listed.end(), face.key))
      surface.facets.push_back(corners(volume, face));
  if (!surface.facet_markers.empty()) surface.facet_markers.resize(surface.facets.size(), 0);
  drop_unused_vertices(surface);
  return surface;
}

}  // namespace holdfast
