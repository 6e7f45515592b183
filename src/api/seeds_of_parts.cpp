// Points in the regions of a pasted surface, by the tetrahedra of a mesh.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "api/mesh.h"
#include "exact/predicates.h"
#include "holdfast/seeds.h"
#include "mesh/disjoint_sets.h"
#include "numbers/random.h"
#include "numbers/sorted.h"
#include "numbers/vector.h"

namespace holdfast {
namespace {

/// A mesh out to a box, with its pieces: the connected sets of tetrahedra between facets.
class Pieces {
 public:
  explicit Pieces(const Result& mesh) : volume_(mesh.volume), sets_(mesh.volume.tetrahedra.size()) {
    std::set<Triangle> walls;
    for (const Triangle& facet : volume_.facets) walls.insert(ascending(facet));
    const auto count = static_cast<Index>(volume_.tetrahedra.size());
    is_outside_.assign(count, 0);
    for (Index t = 0; t < count; ++t)
      for (std::size_t i = 0; i < 4; ++i) {
        const Index next = mesh.neighbours[t][i];
        if (next == no_entity)
          is_outside_[t] = 1;
        else if (next > t && !walls.contains(face(t, i)))
          sets_.unite(t, next);
      }
    for (Index t = 0; t < count; ++t)
      if (is_outside_[t] != 0) is_outside_[sets_.root(t)] = 1;
  }

  /// For each piece that does not reach the box: a point in its roundest tetrahedron, and its region. A piece
  /// in which no double is found is left out.
  [[nodiscard]] std::vector<RegionSeed> seeds() {
    std::vector<std::optional<RegionSeed>> of_root(volume_.tetrahedra.size());
    std::vector<double> best(volume_.tetrahedra.size(), 0);
    for (Index t = 0; t < volume_.tetrahedra.size(); ++t) {
      const Index root = sets_.root(t);
      if (is_outside_[root] != 0) continue;
      const double room = room_in(t);
      if (!(room > best[root])) continue;
      const Point middle = middle_of(t);
      if (!holds(t, middle)) continue;
      best[root] = room;
      of_root[root] = RegionSeed{middle, volume_.regions[t]};
    }
    seed_thin_pieces(of_root);
    std::vector<RegionSeed> seeds;
    for (const auto& seed : of_root)
      if (seed) seeds.push_back(*seed);
    return seeds;
  }

 private:
  /// Of pieces whose tetrahedra are so thin that rounding puts their middles outside.
  void seed_thin_pieces(std::vector<std::optional<RegionSeed>>& of_root) {
    constexpr int kMostTetrahedra = 64;  // of a piece: seconds at most, if pieces are many
    std::vector<int> tried(of_root.size(), 0);
    for (Index t = 0; t < volume_.tetrahedra.size(); ++t) {
      const Index root = sets_.root(t);
      if (is_outside_[root] != 0 || of_root[root] || tried[root]++ == kMostTetrahedra) continue;
      if (const std::optional<Point> found = any_point_in(t)) of_root[root] = {*found, volume_.regions[t]};
    }
  }

  [[nodiscard]] Triangle face(Index t, std::size_t opposite) const {
    const Tetrahedron& corners = volume_.tetrahedra[t];
    return ascending(
        Triangle{corners[(opposite + 1) % 4], corners[(opposite + 2) % 4], corners[(opposite + 3) % 4]});
  }
  [[nodiscard]] const Point& at(Index t, std::size_t i) const {
    return volume_.vertices[volume_.tetrahedra[t][i]];
  }

  /// The volume by the largest of the products of two sides: the least height, but for a small factor.
  [[nodiscard]] double room_in(Index t) const {
    const Vector u = at(t, 1) - at(t, 0), v = at(t, 2) - at(t, 0), w = at(t, 3) - at(t, 0);
    const double most = std::max({dot(u, u), dot(v, v), dot(w, w)});
    return std::fabs(dot(cross(u, v), w)) / most;
  }

  [[nodiscard]] Point middle_of(Index t) const { return mean_of(t, {0.25, 0.25, 0.25, 0.25}); }

  [[nodiscard]] Point mean_of(Index t, const std::array<double, 4>& weights) const {
    Point mean{};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 3; ++k) mean[k] += weights[i] * at(t, i)[k];
    return mean;
  }

  /// Where a tetrahedron is a tenth of a last bit thin, one of about ten points in it rounds to one in it.
  [[nodiscard]] std::optional<Point> any_point_in(Index t) const {
    constexpr int kTrials = 1000;
    numbers::Random random(t);
    for (int trial = 0; trial < kTrials; ++trial) {
      std::array<double, 4> weights{};
      double sum = 0;
      for (double& w : weights) sum += w = static_cast<double>(random() >> 40u);
      for (double& w : weights) w /= sum;
      if (const Point p = mean_of(t, weights); holds(t, p)) return p;
    }
    return std::nullopt;
  }

  /// Exact, for vertices that are doubles.
  [[nodiscard]] bool holds(Index t, const Point& p) const {
    std::array<const double*, 4> corners{};
    for (std::size_t i = 0; i < 4; ++i) corners[i] = at(t, i).data();
    const auto sign = [&] { return exact::orient3d(corners[0], corners[1], corners[2], corners[3]); };
    const int whole = sign();
    for (std::size_t i = 0; i < 4; ++i) {
      const double* const corner = std::exchange(corners[i], p.data());
      if (whole == 0 || sign() != whole) return false;
      corners[i] = corner;
    }
    return true;
  }

  const Volume& volume_;
  DisjointSets sets_;
  std::vector<std::uint8_t> is_outside_;  // also by root
};

/// The mesh of the parts as far as their regions are known.
Result classified(const PasteResult& pasted, Options options, Keep keep) {
  options.keep = keep;
  options.drop_outside = true;
  options.stop_after = Stage::classify;
  options.neighbours = true;
  Result found = mesh(pasted, options);
  if (is_interruption(found.outcome)) throw Interrupted(found.outcome);
  return found;
}

/// The regions of the parts among those of `seeds`: with a box, space in no part has regions, too.
std::set<int> regions_of_parts(const PasteResult& pasted, const Options& options,
                               std::span<const RegionSeed> seeds) {
  std::set<int> ids;
  for (const PastedPart& part : pasted.parts) {
    ids.insert(part.id);
    for (const RegionSeed& seed : part.seeds) ids.insert(seed.id);
  }
  const auto is_known = [&](const RegionSeed& seed) { return ids.contains(seed.id); };
  if (std::all_of(seeds.begin(), seeds.end(), is_known)) return ids;
  const Result kept = classified(pasted, options, Keep::automatic);  // has those that parts share
  ids.insert(kept.volume.regions.begin(), kept.volume.regions.end());
  return ids;
}

}  // namespace

Surface with_seeds(const PasteResult& pasted, const Options& options) {
  Surface surface = pasted.surface;
  if (!surface.regions.empty()) return surface;  // a single file has them itself
  const Result found = classified(pasted, options, Keep::box);
  if (found.outcome != Outcome::done) return surface;
  const std::vector<RegionSeed> seeds = Pieces(found).seeds();
  const std::set<int> of_parts = regions_of_parts(pasted, options, seeds);
  for (const RegionSeed& seed : seeds) {
    if (of_parts.contains(seed.id))
      surface.regions.push_back(seed);
    else
      surface.holes.push_back(seed.where);
  }
  return surface;
}

}  // namespace holdfast
