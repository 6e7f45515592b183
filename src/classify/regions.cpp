#include "classify/regions.h"

#include <algorithm>
#include <deque>
#include <stdexcept>
#include <unordered_map>

namespace holdfast {
namespace {

// Regions by slot in order of discovery; the outside, which ghosts belong to, is 0.
RegionId flood(const TetMesh& mesh, std::vector<RegionId>& of_tet) {
  of_tet.assign(mesh.slot_count(), kNone);
  std::vector<Tet> stack;
  const auto spread = [&](RegionId region) {
    while (!stack.empty()) {
      const Tet t = stack.back();
      stack.pop_back();
      for (int i = 0; i < 4; ++i) {
        const Tet n = tet_of(mesh.neighbour(t, i));
        if (mesh.is_facet(face_code(t, i)) || of_tet[n] != kNone) continue;
        of_tet[n] = region;
        stack.push_back(n);
      }
    }
  };
  for (Tet t = 0; t < mesh.slot_count(); ++t)
    if (mesh.alive(t) && mesh.is_ghost(t)) {
      of_tet[t] = 0;
      stack.push_back(t);
    }
  spread(0);
  RegionId count = 1;
  for (Tet t = 0; t < mesh.slot_count(); ++t) {
    if (!mesh.alive(t) || of_tet[t] != kNone) continue;
    of_tet[t] = count;
    stack.push_back(t);
    spread(count++);
  }
  return count;
}

std::uint64_t hash(Triangle f) {
  std::sort(f.begin(), f.end());
  std::uint64_t h = f[0] * 0x9E3779B97F4A7C15ull;
  h = (h ^ (h >> 29) ^ f[1]) * 0xBF58476D1CE4E5B9ull;
  return (h ^ (h >> 31) ^ f[2]) * 0x94D049BB133111EBull;
}
struct SameCorners {
  bool operator()(Triangle f, Triangle g) const {
    std::sort(f.begin(), f.end());
    std::sort(g.begin(), g.end());
    return f == g;
  }
};
struct CornerHash {
  std::size_t operator()(const Triangle& f) const { return static_cast<std::size_t>(hash(f)); }
};

bool same_turn(const Triangle& f, const Triangle& g) {
  for (std::size_t k = 0; k < 3; ++k)
    if (f[0] == g[k]) return f[1] == g[(k + 1) % 3];
  return false;
}

// The regions on the sides of each facet, by the mesh faces that carry facet bits.
void find_sides(const TetMesh& mesh, std::span<const Triangle> facets, Regions& regions) {
  std::unordered_map<Triangle, Index, CornerHash, SameCorners> index;
  index.reserve(facets.size());
  for (Index f = 0; f < facets.size(); ++f) index.emplace(facets[f], f);
  regions.of_facet.assign(facets.size(), {kNone, kNone});
  for (Tet t = 0; t < mesh.slot_count(); ++t) {
    if (!mesh.alive(t) || (mesh.flags(t) & kFacetBits) == 0) continue;
    for (int i = 0; i < 4; ++i) {
      if (!mesh.is_facet(face_code(t, i))) continue;
      // (f0 f1 f2 t's apex) is positive: t lies in front of the face as it turns.
      const auto corners = mesh.face_vertices(face_code(t, i));
      const auto it = index.find(corners);
      if (it == index.end()) throw std::logic_error("holdfast: a facet face is no input facet");
      regions.of_facet[it->second][same_turn(facets[it->second], corners) ? 0 : 1] = regions.of_tet[t];
    }
  }
  for (const auto& sides : regions.of_facet)
    if (sides[0] == kNone || sides[1] == kNone) throw std::logic_error("holdfast: a facet is no mesh face");
}

void number_by_least_facet(Regions& regions) {
  std::vector<RegionId> rank(regions.count, kNone);
  rank[0] = 0;
  RegionId next = 1;
  for (const auto& sides : regions.of_facet)
    for (const RegionId r : sides)
      if (rank[r] == kNone) rank[r] = next++;
  for (RegionId& r : regions.of_tet)
    if (r != kNone) r = rank[r];
  for (auto& sides : regions.of_facet) sides = {rank[sides[0]], rank[sides[1]]};
}

}  // namespace

Regions flood_regions(const TetMesh& mesh, std::span<const Triangle> facets) {
  Regions regions;
  regions.count = flood(mesh, regions.of_tet);
  find_sides(mesh, facets, regions);
  number_by_least_facet(regions);
  return regions;
}

std::optional<std::vector<int>> winding_numbers(const Regions& regions) {
  struct Crossing {
    RegionId to;
    int step;
  };
  std::vector<std::vector<Crossing>> graph(regions.count);
  for (const auto& [front, back] : regions.of_facet) {
    if (front == back) continue;
    graph[front].push_back({back, 1});
    graph[back].push_back({front, -1});
  }
  std::vector<int> winding(regions.count, 0);
  std::vector<bool> known(regions.count, false);
  std::deque<RegionId> queue{0};
  known[0] = true;
  while (!queue.empty()) {
    const RegionId r = queue.front();
    queue.pop_front();
    for (const Crossing& c : graph[r]) {
      if (!known[c.to]) {
        known[c.to] = true;
        winding[c.to] = winding[r] + c.step;
        queue.push_back(c.to);
      } else if (winding[c.to] != winding[r] + c.step) {
        return std::nullopt;
      }
    }
  }
  return winding;
}

Located locate(const TetMesh& mesh, const Regions& regions, const Point& p) {
  const exact::PointRef q{p.data(), nullptr};
  Tet t = 0;
  while (!mesh.alive(t) || mesh.is_ghost(t)) ++t;
  // A visibility walk that remembers where it came from and starts at a changing face cannot cycle for
  // ever; a mesh that is not Delaunay needs the changing start (Devillers, Pion, Teillaud 2002).
  unsigned start = 0;
  for (bool moved = true; moved;) {
    moved = false;
    for (unsigned k = 0; k < 4 && !moved; ++k) {
      const int i = static_cast<int>((k + start) & 3u);
      const auto f = mesh.face_vertices(face_code(t, i));
      if (mesh.orient(f[0], f[1], f[2], q) >= 0) continue;
      t = tet_of(mesh.neighbour(t, i));
      moved = true;
    }
    start = start * 1664525u + 1013904223u;
    start ^= start >> 13;
    if (mesh.is_ghost(t)) return {0, false};
  }
  Located located{regions.of_tet[t], false};
  std::vector<int> on;
  for (int i = 0; i < 4; ++i) {
    const auto f = mesh.face_vertices(face_code(t, i));
    if (mesh.orient(f[0], f[1], f[2], q) == 0) on.push_back(i);
  }
  if (on.size() == 1) located.on_constraint = mesh.is_facet(face_code(t, on[0]));
  if (on.size() == 2)
    located.on_constraint =
        mesh.is_segment(t, 5 - kEdgeOf[static_cast<std::size_t>(on[0])][static_cast<std::size_t>(on[1])]);
  if (on.size() == 3) located.on_constraint = true;
  return located;
}

}  // namespace holdfast
