#include "suppress/suppress.h"

#include <algorithm>
#include <random>

#include "mesh/traverse.h"
#include "suppress/degree.h"
#include "suppress/needed.h"
#include "suppress/refill.h"
#include "suppress/remove_or_recentre.h"
#include "suppress/shake.h"
#include "suppress/tuning.h"

namespace holdfast {
namespace {

using Points = std::vector<Vertex>;  // the remaining points

// What the steps share: a mesh whose vertices from `first_free` on may be removed, and its random flips.
struct Site {
  TetMesh& mesh;
  Vertex first_free;
  std::mt19937_64& random;
  Flipper& flipper;
  const Tell& tell;
};

std::size_t count_unrounded(const TetMesh& mesh, const Points& points) {
  return static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [&](Vertex p) { return !mesh.is_explicit(p); }));
}

std::size_t drop_the_gone(const TetMesh& mesh, Points& points) {
  return std::erase_if(points, [&](Vertex p) { return !mesh.in_mesh(p); });
}

// Repeats rounds until one removes or rounds no point.
void shrink(const Site& site, Points& points, SuppressStats& stats) {
  int idle = 0;
  for (int round = 0; round < tuning::kShrinkRounds && idle < tuning::kShrinkIdle && !points.empty();
       ++round) {
    const std::size_t before = points.size(), unrounded_before = count_unrounded(site.mesh, points);
    std::erase_if(points, [&](Vertex p) {
      site.tell();
      const Fate fate = remove_or_recentre(site.mesh, p, {});
      stats.collapsed += fate == Fate::collapsed ? 1 : 0;
      stats.filled += fate == Fate::filled ? 1 : 0;
      return fate == Fate::collapsed || fate == Fate::filled;
    });
    const bool gained = points.size() < before || count_unrounded(site.mesh, points) < unrounded_before;
    idle = gained ? 0 : idle + 1;
  }
}

// Points that no double can replace are worth more effort.
void remove_harder(const Site& site, Vertex p) {
  TetMesh& mesh = site.mesh;
  const bool is_explicit = mesh.is_explicit(p);
  if (lower_degree(mesh, site.flipper, p, Flipper::kDeep,
                   is_explicit ? tuning::kQuickBudget : tuning::kPatientBudget)) {
    const Fate fate = remove_or_recentre(mesh, p, {});
    if (fate == Fate::collapsed || fate == Fate::filled) return;
  }
  const Growth& growth = is_explicit ? tuning::kQuickGrowth : tuning::kPatientGrowth;
  if (refill_without(mesh, p, site.first_free, growth, site.random)) return;
  if (!mesh.is_explicit(p)) round_with_neighbours(mesh, p, site.first_free, tuning::kMostSteps);
}

void merge_with_neighbours(const Site& site, Vertex p) {
  TetMesh& mesh = site.mesh;
  for (const Vertex q : link_vertices(mesh, p))
    if (q >= site.first_free && mesh.in_mesh(p) && find_edge(mesh, p, q) != kNone)
      merge(mesh, p, q, site.first_free, tuning::kMergeSteps, tuning::kMergeSearch);
}

// Tries larger cavities, of one point and then of two. Returns whether another try is worth its time.
bool refill(const Site& site, Points& points, SuppressStats& stats) {
  TetMesh& mesh = site.mesh;
  const std::size_t before = points.size(), unrounded_before = count_unrounded(mesh, points);
  for (const Vertex p : points) {
    site.tell();
    if (mesh.in_mesh(p)) remove_harder(site, p);
  }
  stats.filled += drop_the_gone(mesh, points);
  for (const Vertex p : points)
    if (mesh.in_mesh(p)) merge_with_neighbours(site, p);
  stats.merged += drop_the_gone(mesh, points);
  const std::size_t gone = before - points.size(), unrounded = count_unrounded(mesh, points);
  const std::size_t rounded = unrounded_before - std::min(unrounded_before, unrounded);
  const std::size_t worthwhile = unrounded > 0 ? tuning::kWorthwhileWithoutDoubles : tuning::kWorthwhile;
  return (gone + rounded) * worthwhile > before;
}

// Removes remaining points from other meshes round them, except those that are proven necessary.
void insist(const Site& site, Points& points, SuppressStats& stats) {
  TetMesh& mesh = site.mesh;
  // In proportion to the rest of the work, so that it has an effect where few points are left.
  const std::size_t most_shakes =
      std::min(tuning::kMostPointShakes, tuning::kFewShakes + mesh.tet_count() / tuning::kTetsAShake);
  Points spare = points;
  std::erase_if(spare, [&](Vertex p) { return is_needed(mesh, p, site.first_free); });
  std::size_t shakes = 0;
  int idle = 0;
  for (int round = 0; round < tuning::kInsistRounds && idle < tuning::kInsistIdle && !spare.empty();
       ++round) {
    for (const Vertex p : spare) {
      if (shakes++ == most_shakes) break;
      site.tell();
      shake(mesh, site.flipper, p, tuning::kShakenEdgesOfPoint, site.random);
      lower_degree(mesh, site.flipper, p, Flipper::kDeep, tuning::kShakenBudget);
      remove_or_recentre(mesh, p, {});
    }
    stats.filled += drop_the_gone(mesh, points);
    idle = drop_the_gone(mesh, spare) > 0 ? 0 : idle + 1;
    if (shakes > most_shakes) return;
  }
}

bool round_at_random(const Site& site, Vertex p) {
  for (int k = 0; k < tuning::kRandomTries; ++k)
    if (round_completely(site.mesh, p, site.first_free, tuning::kMostRandomSteps, site.tell, site.random))
      return true;
  return false;
}

// Only complete searches are left to try, and other meshes round the points that they do not remove.
void round_the_rest(const Site& site, Points& points, SuppressStats& stats) {
  TetMesh& mesh = site.mesh;
  for (int round = 0; round < tuning::kRoundingRounds; ++round) {
    Points rest = points;
    std::erase_if(rest, [&](Vertex p) { return mesh.is_explicit(p); });
    if (rest.empty()) return;
    for (const Vertex p : rest) {
      site.tell();
      if (!mesh.in_mesh(p)) continue;
      if (round_completely(mesh, p, site.first_free, tuning::kMostSteps, site.tell)) continue;
      if (round_at_random(site, p)) continue;
      shake(mesh, site.flipper, p, tuning::kShakenEdgesOfPoint, site.random);
      remove_or_recentre(mesh, p, {});
    }
    stats.filled += drop_the_gone(mesh, points);
  }
}

}  // namespace

SuppressStats suppress(TetMesh& mesh, std::vector<Vertex> points, Vertex first_free, Monitor& monitor,
                       std::uint64_t seed) {
  const auto all = static_cast<double>(points.size());
  const Tell tell = [&] { monitor.poll(Stage::suppress, 1.0 - static_cast<double>(points.size()) / all); };
  std::mt19937_64 random(seed);
  Flipper flipper(mesh, random);
  const Site site{mesh, first_free, random, flipper, tell};
  SuppressStats stats;
  do shrink(site, points, stats);
  while (!points.empty() && refill(site, points, stats));
  shrink(site, points, stats);
  insist(site, points, stats);
  round_the_rest(site, points, stats);
  stats.left = points.size();
  stats.unrounded = count_unrounded(mesh, points);
  return stats;
}

}  // namespace holdfast
