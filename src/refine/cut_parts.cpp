#include "refine/cut_parts.h"

#include <algorithm>

#include "mesh/measure.h"
#include "mesh/parallel.h"
#include "refine/tets_inside.h"
#include "refine/tuning.h"

namespace holdfast {
namespace {

Cuts cuts_of(const TetMesh& mesh, const std::vector<Tet>& tets, double worth_cutting, double least_share) {
  std::vector<Cuts::Sample> samples;
  for (std::size_t k = 0; k < tets.size(); k += 1 + tets.size() / tuning::kCutSamples)
    samples.push_back({centroid(mesh, tets[k]), 1});
  return {std::move(samples), levels_for(static_cast<double>(tets.size()), worth_cutting), least_share};
}

// Joining parts once more takes sweeps over the whole mesh, which are expensive if it is large.
double worth_cutting_again(const TetMesh& mesh) {
  return std::clamp(tuning::kShareWorthCuttingAgain * static_cast<double>(mesh.tet_count()),
                    tuning::kWorthCuttingAgain, tuning::kWorthCutting);
}

// The tetrahedra at these vertices and one more ring, because cavities need room to grow. Two sweeps over all
// tetrahedra take less time than gathering balls.
std::vector<Tet> rings_round(const VolumeData& volume, const std::vector<Vertex>& vertices,
                             const Threads& threads) {
  std::vector<std::uint8_t> reached(volume.mesh.vertex_count(), 0);
  for (const Vertex v : vertices) reached[v] = 1;
  std::vector<Tet> tets;
  for (int ring = 0; ring < tuning::kRings; ++ring) {
    for (const Tet t : tets)
      for (const Vertex v : volume.mesh.corners(t)) reached[v] = 1;
    tets = tets_inside(volume, threads, [&](Tet t) {
      const TetMesh::Corners& c = volume.mesh.corners(t);
      return std::any_of(c.begin(), c.end(), [&](Vertex v) { return reached[v] != 0; });
    });
  }
  return tets;
}

}  // namespace

std::unique_ptr<Parts> cut_into_parts(const VolumeData& volume, const std::vector<Tet>& tets,
                                      const Cuts& cuts, double most_at_cuts, const Threads& threads) {
  std::vector<std::uint32_t> part_of(volume.mesh.slot_count(), kNone);
  parallel_ranges(threads, tets.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k)
      part_of[tets[k]] = cuts.part_of(centroid(volume.mesh, tets[k]));
  });
  auto parts = std::make_unique<Parts>(volume, part_of, cuts.part_count(), threads);
  if (parts->share_at_cuts(threads) > most_at_cuts) parts.reset();
  return parts;
}

std::unique_ptr<Parts> cut_evenly(const VolumeData& volume, const Threads& threads) {
  const std::vector<Tet> tets = tets_inside(volume, threads);
  const Cuts cuts = cuts_of(volume.mesh, tets, tuning::kWorthCutting, 0.5);
  if (cuts.part_count() == 1) return {};
  return cut_into_parts(volume, tets, cuts, tuning::kMostAtCuts, threads);
}

std::unique_ptr<Parts> join_and_cut_again(Parts& parts, const Threads& threads) {
  const auto before = static_cast<double>(parts.tet_count());
  parts.join(threads);
  const VolumeData& volume = parts.whole();
  const std::vector<Vertex> between = parts.vertices_between();
  const std::vector<Tet> tets = rings_round(volume, between, threads);
  if (tets.empty()) return {};
  // What is left lies along the planes of the last cut. If these halve it, the same planes would be chosen
  // again, and everything along them would be left once more.
  std::unique_ptr<Parts> again;
  if (static_cast<double>(tets.size()) < tuning::kMostLeft * before)
    if (const Cuts cuts = cuts_of(volume.mesh, tets, worth_cutting_again(volume.mesh), tuning::kLeastShare);
        cuts.part_count() > 1)
      again = cut_into_parts(volume, tets, cuts, tuning::kMostAtCuts, threads);
  if (!again) again = cut_into_parts(volume, tets, Cuts({}, 0), 1, threads);
  again->set_cut_before(between, threads);
  return again;
}

}  // namespace holdfast
