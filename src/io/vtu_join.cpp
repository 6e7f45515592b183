#include "io/vtu_join.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <set>
#include <utility>

#include "numbers/finite.h"

namespace holdfast::io {
namespace {

bool same(const Point& a, const Point& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Numbers vertices in the order of their global ids.
void number_by_ids(std::vector<VtuPiece>& pieces, MeshData& whole) {
  struct Named {
    std::int64_t id;
    std::size_t piece, vertex;
  };
  std::vector<Named> all;
  for (std::size_t k = 0; k < pieces.size(); ++k)
    for (std::size_t v = 0; v < pieces[k].block.point_ids.size(); ++v)
      all.push_back({pieces[k].block.point_ids[v], k, v});
  std::stable_sort(all.begin(), all.end(), [](const Named& a, const Named& b) { return a.id < b.id; });
  std::vector<std::vector<int>> markers;
  for (VtuPiece& piece : pieces) {
    piece.number.resize(piece.block.mesh.vertices.size());
    markers.push_back(piece.block.mesh.vertex_markers.take(piece.number.size()));
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Named& named = all[i];
    const Point& p = pieces[named.piece].block.mesh.vertices[named.vertex];
    const auto fail = [&](const std::string& reason) {
      throw FileError(pieces[named.piece].path, "point " + std::to_string(named.vertex), reason);
    };
    if (named.id < 0) fail("its id in the whole, " + std::to_string(named.id) + ", is negative");
    if (i == 0 || all[i - 1].id != named.id)
      whole.add_vertex(p, tag_of(markers[named.piece], named.vertex));
    else if (!same(p, whole.vertices.back()))
      fail("it has the id " + std::to_string(named.id) +
           " in the whole, as a point at another place has in " + pieces[all[i - 1].piece].path.string());
    pieces[named.piece].number[named.vertex] = static_cast<Index>(whole.vertices.size() - 1);
  }
}

/// Merges vertices with those of earlier pieces at the same place; points of one piece stay distinct.
void number_by_places(std::vector<VtuPiece>& pieces, MeshData& whole) {
  std::map<Point, Index> at;
  std::size_t joined = 0;
  for (VtuPiece& piece : pieces) {
    MeshData& mesh = piece.block.mesh;
    const std::vector<int> markers = mesh.vertex_markers.take(mesh.vertices.size());
    const auto before = static_cast<Index>(whole.vertices.size());
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      const auto there = is_finite(mesh.vertices[v]) ? at.find(mesh.vertices[v]) : at.end();
      const bool is_known = there != at.end() && there->second < before;
      if (!is_known) whole.add_vertex(mesh.vertices[v], tag_of(markers, v));
      joined += is_known ? 1 : 0;
      piece.number.push_back(is_known ? there->second : static_cast<Index>(whole.vertices.size() - 1));
    }
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      if (is_finite(mesh.vertices[v])) at.try_emplace(mesh.vertices[v], piece.number[v]);
  }
  whole.leave_out(joined, "points at the places of others, of pieces that have no ids of points,",
                  "point at the place of another, of pieces that have no ids of points,");
}

template <std::size_t N>
std::array<Index, N> ascending_corners(std::array<Index, N> corners, const std::vector<Index>& number) {
  for (Index& v : corners) v = number[v];
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Adds the entities that no earlier piece has.
template <std::size_t N>
void keep_new(std::vector<std::array<Index, N>>& entities, Tags& markers, const std::vector<Index>& number,
              std::set<std::array<Index, N>>& earlier) {
  const std::vector<int> given = markers.take(entities.size());
  std::vector<std::array<Index, N>> kept;
  std::vector<std::array<Index, N>> fresh;
  Tags kept_markers;
  for (std::size_t i = 0; i < entities.size(); ++i) {
    const std::array<Index, N> corners = ascending_corners(entities[i], number);
    if (earlier.count(corners) > 0) continue;
    fresh.push_back(corners);
    kept_markers.add(kept.size(), tag_of(given, i));
    kept.push_back(entities[i]);
  }
  earlier.insert(fresh.begin(), fresh.end());
  entities = std::move(kept);
  markers = std::move(kept_markers);
}

/// Moves the tetrahedra of all pieces to the whole, in the order of their ids.
void add_tetrahedra_by_ids(std::vector<VtuPiece>& pieces, MeshData& whole) {
  struct Named {
    std::int64_t id;
    Tetrahedron corners;
    int region;
  };
  std::vector<Named> all;
  for (VtuPiece& piece : pieces) {
    MeshData& mesh = piece.block.mesh;
    const std::vector<int> regions = mesh.regions.take(mesh.tetrahedra.size());
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
      Tetrahedron corners = mesh.tetrahedra[t];
      for (Index& v : corners) v = piece.number[v];
      all.push_back({piece.block.tetrahedron_ids[t], corners, tag_of(regions, t)});
    }
    mesh.tetrahedra.clear();
    mesh.regions = {};
  }
  std::stable_sort(all.begin(), all.end(), [](const Named& a, const Named& b) { return a.id < b.id; });
  for (const Named& named : all) whole.add_tetrahedron(named.corners, named.region);
}

bool has_second_order(const MeshData& mesh) {
  return !mesh.mids.tetrahedra.empty() || !mesh.mids.facets.empty() || !mesh.mids.segments.empty();
}

}  // namespace

MeshData joined(std::vector<VtuPiece>& pieces) {
  MeshData whole;
  const auto all_of = [&](auto has) { return std::all_of(pieces.begin(), pieces.end(), has); };
  const bool by_ids = all_of(
      [](const VtuPiece& piece) { return piece.block.point_ids.size() == piece.block.mesh.vertices.size(); });
  if (by_ids)
    number_by_ids(pieces, whole);
  else
    number_by_places(pieces, whole);
  if (all_of([](const VtuPiece& piece) {
        return piece.block.tetrahedron_ids.size() == piece.block.mesh.tetrahedra.size() &&
               !has_second_order(piece.block.mesh);
      }))
    add_tetrahedra_by_ids(pieces, whole);
  std::set<Triangle> facets;
  std::set<Segment> segments;
  for (VtuPiece& piece : pieces) {
    MeshData& mesh = piece.block.mesh;
    if (!has_second_order(mesh) && mesh.quadrangles.empty()) {
      keep_new(mesh.facets, mesh.facet_markers, piece.number, facets);
      keep_new(mesh.segments, mesh.segment_markers, piece.number, segments);
    }
    for (Remark& remark : mesh.remarks) remark.message = piece.told_as + remark.message;
    append(whole, std::move(mesh), piece.number);
  }
  return whole;
}

}  // namespace holdfast::io
