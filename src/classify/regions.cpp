#include "classify/regions.h"

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <stdexcept>

#include "mesh/disjoint_sets.h"
#include "mesh/traverse.h"
#include "surface/facet_index.h"

namespace holdfast {
namespace {

// Unites the tetrahedra that no facet separates, and all ghosts. Neighbours have slots close to each other,
// so a sweep over slots stays in the caches; a walk from neighbour to neighbour does not. Each range of slots
// is first united by itself; few pairs join ranges.
class Unification {
 public:
  Unification(const TetMesh& mesh, const Threads& threads) : mesh_(mesh), sets_(mesh.slot_count()) {
    parallel_ranges(threads, mesh.slot_count(), [this](std::size_t first, std::size_t last) {
      std::vector<std::array<Tet, 2>> across = unite_within(static_cast<Tet>(first), static_cast<Tet>(last));
      const std::scoped_lock lock(mutex_);
      across_.push_back(std::move(across));
    });
    for (const auto& pairs : across_)
      for (const auto& [t, n] : pairs) sets_.unite(t, n);
    for (const Tet ghost : ghosts_) sets_.unite(ghost, ghosts_.front());
  }

  [[nodiscard]] const DisjointSets& sets() const { return sets_; }
  /// The lowest ghost, or kNone.
  [[nodiscard]] Tet outside() const { return ghosts_.empty() ? kNone : sets_.root_of(ghosts_.front()); }

 private:
  // Returns the pairs that lead to lower ranges. The members of a range have parents in the same range.
  std::vector<std::array<Tet, 2>> unite_within(Tet first, Tet last) {
    std::vector<std::array<Tet, 2>> across;
    Tet ghost = kNone;
    for (Tet t = first; t < last; ++t) {
      if (!mesh_.alive(t)) continue;
      for (int i = 0; i < 4; ++i) {
        const Tet n = tet_of(mesh_.neighbour(t, i));
        if (n >= t || mesh_.is_facet(face_code(t, i))) continue;
        if (n >= first)
          sets_.unite(t, n);
        else
          across.push_back({t, n});
      }
      if (!mesh_.is_ghost(t)) continue;
      if (ghost != kNone) sets_.unite(t, ghost);
      ghost = t;
    }
    if (ghost == kNone) return across;
    const std::scoped_lock lock(mutex_);
    ghosts_.push_back(ghost);
    return across;
  }

  const TetMesh& mesh_;
  DisjointSets sets_;
  std::mutex mutex_;
  std::vector<std::vector<std::array<Tet, 2>>> across_;
  std::vector<Tet> ghosts_;  // one for each range that has any
};

// Numbers the regions, by slot: 0 is the outside, which contains the ghosts; others follow in the order of
// their first slots. Returns the number of regions.
RegionId number_regions(const TetMesh& mesh, std::vector<RegionId>& of_tet, const Threads& threads) {
  const Unification united(mesh, threads);
  const DisjointSets& sets = united.sets();
  std::mutex mutex;
  std::map<std::size_t, std::vector<Tet>> first_slots;  // of the sets, by range
  parallel_ranges(threads, mesh.slot_count(), [&](std::size_t first, std::size_t last) {
    std::vector<Tet> own;
    for (auto t = static_cast<Tet>(first); t < last; ++t)
      if (sets.root_of(t) == t && mesh.alive(t)) own.push_back(t);
    const std::scoped_lock lock(mutex);
    first_slots[first] = std::move(own);
  });
  of_tet.assign(mesh.slot_count(), kNone);
  RegionId count = 1;
  for (const auto& [first, slots] : first_slots)
    for (const Tet t : slots) of_tet[t] = t == united.outside() ? 0 : count++;
  parallel_ranges(threads, mesh.slot_count(), [&](std::size_t first, std::size_t last) {
    for (auto t = static_cast<Tet>(first); t < last; ++t)
      if (const Tet root = sets.root_of(t); root != t) of_tet[t] = of_tet[root];
  });
  return count;
}

// Whether two triangles with the same corners have the same orientation.
bool same_turn(const Triangle& f, const Triangle& g) {
  for (std::size_t k = 0; k < 3; ++k)
    if (f[0] == g[k]) return f[1] == g[(k + 1) % 3];
  return false;
}

// Finds the regions on the sides of each facet, from the mesh faces that carry facet bits.
void find_sides(const TetMesh& mesh, std::span<const Triangle> facets, Regions& regions,
                const Threads& threads) {
  const FacetIndex index(mesh.vertex_count(), facets);
  regions.of_facet.assign(facets.size(), {kNone, kNone});
  const auto find_at = [&](Tet t) {
    if (!mesh.alive(t) || (mesh.flags(t) & kFacetBits) == 0) return;
    for (int i = 0; i < 4; ++i) {
      if (!mesh.is_facet(face_code(t, i))) continue;
      // (f0 f1 f2 t's apex) is positive: t lies in front of the face as oriented.
      const Triangle corners = mesh.face_vertices(face_code(t, i));
      const Index f = index.find(corners);
      if (f == no_index) throw std::logic_error("holdfast: a face with a facet bit is no facet");
      regions.of_facet[f][same_turn(facets[f], corners) ? 0 : 1] = regions.of_tet[t];
    }
  };
  parallel_ranges(threads, mesh.slot_count(), [&](std::size_t first, std::size_t last) {
    for (auto t = static_cast<Tet>(first); t < last; ++t) find_at(t);
  });
  for (const auto& sides : regions.of_facet)
    if (sides[0] == kNone || sides[1] == kNone) throw std::logic_error("holdfast: a facet is no mesh face");
}

void number_by_least_facet(Regions& regions, const Threads& threads) {
  std::vector<RegionId> rank(regions.count, kNone);
  rank[0] = 0;
  RegionId next = 1;
  for (const auto& sides : regions.of_facet)
    for (const RegionId r : sides)
      if (rank[r] == kNone) rank[r] = next++;
  parallel_ranges(threads, regions.of_tet.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t)
      if (regions.of_tet[t] != kNone) regions.of_tet[t] = rank[regions.of_tet[t]];
  });
  for (auto& sides : regions.of_facet) sides = {rank[sides[0]], rank[sides[1]]};
}

// Breadth-first search of the region graph from the outside.
class WindingSearch {
 public:
  explicit WindingSearch(const Regions& regions)
      : regions_(regions), facets_of_(regions.count), reached_by_(regions.count, kNone) {
    for (Index f = 0; f < regions.of_facet.size(); ++f) {
      const auto& [front, back] = regions.of_facet[f];
      if (front == back) continue;
      facets_of_[front].push_back(f);
      facets_of_[back].push_back(f);
    }
    winding_.number.assign(regions.count, 0);
  }

  Winding run() {
    std::vector<bool> known(regions_.count, false);
    std::vector<RegionId> queue{0};
    known[0] = true;
    for (std::size_t k = 0; k < queue.size(); ++k) {
      const RegionId r = queue[k];
      for (const Index f : facets_of_[r]) {
        const auto& [front, back] = regions_.of_facet[f];
        const RegionId to = r == front ? back : front;
        const int number = winding_.number[r] + (r == front ? 1 : -1);
        if (!known[to]) {
          known[to] = true;
          winding_.number[to] = number;
          reached_by_[to] = f;
          queue.push_back(to);
        } else if (winding_.number[to] != number) {
          const Index other = reached_by_[to] != kNone ? reached_by_[to] : reached_by_[r];
          winding_.conflict = {std::min(other, f), std::max(other, f)};
          return std::move(winding_);
        }
      }
    }
    return std::move(winding_);
  }

 private:
  const Regions& regions_;
  std::vector<std::vector<Index>> facets_of_;  // by region: its facets towards other regions
  std::vector<Index> reached_by_;              // by region: the facet through which it was found
  Winding winding_;
};

// Whether the box of t's corners contains p. Rounding is monotonic, so a strict order of the nearest doubles
// is also one of the exact coordinates.
bool box_holds(const TetMesh& mesh, Tet t, const double* p) {
  for (std::size_t i = 0; i < 3; ++i) {
    bool below = false;
    bool above = false;
    for (const Vertex v : mesh.corners(t)) {
      below = below || mesh.position(v)[i] <= p[i];
      above = above || mesh.position(v)[i] >= p[i];
    }
    if (!below || !above) return false;
  }
  return true;
}

}  // namespace

Regions find_regions(const TetMesh& mesh, std::span<const Triangle> facets, const Threads& threads) {
  Regions regions;
  regions.count = number_regions(mesh, regions.of_tet, threads);
  find_sides(mesh, facets, regions, threads);
  number_by_least_facet(regions, threads);
  return regions;
}

void find_regions_again(TetMesh& mesh, std::span<const Triangle> facets, Regions& regions,
                        const Threads& threads) {
  std::vector<RegionId> region_of(number_regions(mesh, regions.of_tet, threads), kNone);
  region_of[0] = 0;
  std::vector<bool> done(regions.count, false);
  done[0] = true;
  for (Index f = 0; f < facets.size(); ++f) {
    const auto& [front, back] = regions.of_facet[f];
    if (done[front] && done[back]) continue;
    const auto& v = facets[f];
    const Face face = find_face(mesh, v[0], v[1], v[2]);
    if (face == kNone) throw std::logic_error("holdfast: a facet is no mesh face");
    const bool turned = !same_turn(v, mesh.face_vertices(face));
    region_of[regions.of_tet[tet_of(face)]] = turned ? back : front;
    region_of[regions.of_tet[tet_of(mesh.neighbour(face))]] = turned ? front : back;
    done[front] = done[back] = true;
  }
  parallel_ranges(threads, regions.of_tet.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t)
      if (RegionId& r = regions.of_tet[t]; r != kNone) r = region_of[r];
  });
}

std::vector<Index> turned_facets(const Regions& regions) {
  std::map<std::array<RegionId, 2>, std::array<std::vector<Index>, 2>> between;
  for (Index f = 0; f < regions.of_facet.size(); ++f) {
    const auto& [front, back] = regions.of_facet[f];
    if (front != back)
      between[{std::min(front, back), std::max(front, back)}][front < back ? 0 : 1].push_back(f);
  }
  std::vector<Index> turned;
  for (const auto& [pair, ways] : between) {
    // Of equally many, the ones without the least facet.
    const bool second = ways[1].size() != ways[0].size() ? ways[1].size() < ways[0].size()
                                                         : ways[1].front() > ways[0].front();
    const std::vector<Index>& fewer = ways[second ? 1 : 0];
    turned.insert(turned.end(), fewer.begin(), fewer.end());
  }
  std::sort(turned.begin(), turned.end());
  return turned;
}

Winding winding_numbers(const Regions& regions) { return WindingSearch(regions).run(); }

Located locate(const TetMesh& mesh, const Regions& regions, exact::PointRef p) {
  Located located;
  for (Tet t = 0; t < mesh.slot_count(); ++t) {
    if (!mesh.alive(t) || mesh.is_ghost(t) || !box_holds(mesh, t, p.approx)) continue;
    bool holds = true;
    bool on_facet = false;
    for (int i = 0; i < 4 && holds; ++i) {
      const auto f = mesh.face_vertices(face_code(t, i));
      const int side = mesh.orient(f[0], f[1], f[2], p);
      holds = side >= 0;
      on_facet = on_facet || (side == 0 && mesh.is_facet(face_code(t, i)));
    }
    if (!holds) continue;
    located.region = regions.of_tet[t];
    located.in_mesh = true;
    located.on_facet = located.on_facet || on_facet;
  }
  return located;
}

}  // namespace holdfast
