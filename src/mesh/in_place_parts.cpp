#include "mesh/in_place_parts.h"

#include <algorithm>
#include <map>
#include <mutex>

#include "mesh/editor.h"

namespace holdfast {

InPlaceParts::InPlaceParts(TetMesh& mesh, std::span<const Tet> tets, const std::vector<PartNumber>& part_of,
                           std::size_t count, std::size_t spare, const Threads& threads)
    : mesh_(mesh), pools_(mesh.slot_count() + count * spare, count), at_mixed_(mesh.vertex_count(), 0) {
  find_mixed(tets, part_of, threads);
  hold(part_of);
  MeshEditor(mesh_).share_slots(pools_, count, spare);
}

InPlaceParts::~InPlaceParts() {
  MeshEditor editor(mesh_);
  editor.unshare_slots();
  for (const HeldEdge& held : held_edges_) {
    const auto [a, b] = ends_of_edge(mesh_.corners(held.tet), held.edge);
    editor.release_segment(held.tet, a, b);
  }
  for (const Face f : held_faces_) editor.release_facet(f);
}

void InPlaceParts::find_mixed(std::span<const Tet> tets, const std::vector<PartNumber>& part_of,
                              const Threads& threads) {
  std::mutex mutex;
  std::map<std::size_t, std::vector<Tet>> ranges;
  parallel_ranges(threads, tets.size(), [&](std::size_t first, std::size_t last) {
    std::vector<Tet> own;
    for (const Tet t : tets.subspan(first, last - first)) {
      const TetMesh::Corners& c = mesh_.corners(t);
      const PartNumber part = part_of[c[0]];
      if (part == part_of[c[1]] && part == part_of[c[2]] && part == part_of[c[3]])
        pools_.assign(t, part);
      else
        own.push_back(t);
    }
    const std::scoped_lock lock(mutex);
    ranges[first] = std::move(own);
  });
  for (const auto& [first, own] : ranges) mixed_.insert(mixed_.end(), own.begin(), own.end());
  for (const Tet t : mixed_)
    for (const Vertex v : mesh_.corners(t)) at_mixed_[v] = 1;
}

void InPlaceParts::hold(const std::vector<PartNumber>& part_of) {
  MeshEditor editor(mesh_);
  for (const Tet t : mixed_) {
    const TetMesh::Corners& c = mesh_.corners(t);
    for (int edge = 0; edge < 6; ++edge) {
      const auto [a, b] = ends_of_edge(c, edge);
      if (part_of[a] != part_of[b] || mesh_.is_segment(t, edge)) continue;
      editor.set_segment(t, a, b);
      held_edges_.push_back({t, edge});
    }
    for (int side = 0; side < 4; ++side) {
      const auto [u, v, w] = corners_of_face(c, side);
      const Face f = face_code(t, side);
      if (part_of[u] != part_of[v] || part_of[u] != part_of[w] || mesh_.is_facet(f)) continue;
      editor.set_facet(f);
      held_faces_.push_back(f);
    }
  }
}

}  // namespace holdfast
