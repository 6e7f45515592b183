// A large mesh is refined in parts at the same time. But before there are points inside, its tetrahedra span
// it from side to side, and so do the cavities of points. Therefore one thread places the first points on the
// planes that will cut the mesh. Then what lies between two parts is small, and the cavities of points on one
// side seldom reach the other. Those few points are inserted when the parts are joined.
#include "refine/field_points.h"

#include <algorithm>
#include <limits>

#include "mesh/editor.h"
#include "mesh/measure.h"
#include "numbers/vector.h"
#include "refine/cut_parts.h"
#include "refine/front.h"
#include "refine/order.h"
#include "refine/restore_delaunay.h"
#include "refine/section_points.h"
#include "refine/tets_inside.h"
#include "refine/tuning.h"

namespace holdfast {
namespace {

// The number of tetrahedra of the size allowed at t's centroid that fill t.
double tets_in(const VolumeData& volume, const SizeFunction& sizes, Tet t, const Point& middle) {
  constexpr double kRegular = 0.118;  // volume over the cube of an edge
  const TetMesh& mesh = volume.mesh;
  const TetMesh::Corners& c = mesh.corners(t);
  double size = sizes.limit(middle, volume.region_of[t]);
  for (const Vertex v : c)
    size = std::min(size, volume.sizes[v] + sizes.gradation() * distance(mesh.position(v), middle));
  const Point& p = mesh.position(c[0]);
  const double det = dot(mesh.position(c[1]) - p, cross(mesh.position(c[2]) - p, mesh.position(c[3]) - p));
  return 1 + det / 6 / (kRegular * size * size * size);
}

struct ExpectedWork {
  Cuts cuts;
  double tets;  // in the end
};

// Estimated from some of the tetrahedra. Sizes that do not grow are means of the sizes round a point. In a
// mesh without points inside these are means over the whole surface, so there are no cuts then. There are
// none with a metric either, because the points on cuts are computed for spheres.
ExpectedWork expected_work(const VolumeData& volume, const SizeFunction& sizes,
                           const std::vector<Tet>& tets) {
  if (!sizes.grows() || sizes.has_metric()) return {{{}, 0}, 0};
  const std::size_t step = 1 + tets.size() / tuning::kCutSamples;
  std::vector<Cuts::Sample> samples;
  double expected = 0;
  for (std::size_t k = 0; k < tets.size(); k += step) {
    const Point middle = centroid(volume.mesh, tets[k]);
    samples.push_back({middle, tets_in(volume, sizes, tets[k], middle)});
    expected += samples.back().weight * static_cast<double>(step);
  }
  return {{std::move(samples), levels_for(expected, tuning::kWorthCutting)}, expected};
}

// Reserves room for as many more tetrahedra as are expected in all. So the mesh is copied once while it is
// small, and not when the parts are joined. Untouched memory costs nothing, but even that is limited.
void make_room(const VolumeData& volume, double expected) {
  const auto more = static_cast<std::size_t>(expected < tuning::kMostRoom ? expected : tuning::kMostRoom);
  const std::size_t slots = volume.mesh.slot_count() + more;
  const std::size_t vertices = volume.mesh.vertex_count() + more / tuning::kTetsAVertexInside;
  MeshEditor(volume.mesh).reserve(vertices, slots);
  volume.region_of.reserve(slots);
  volume.sizes.reserve(vertices);
}

FieldPoints filled_parts(const VolumeData& volume, const SizeFunction& sizes, const Threads& threads,
                         Monitor& monitor) {
  // More than for the improvement: the first points inside are on the cuts, so tetrahedra join the surface to
  // them from afar (half of the tetrahedra of a torus of a million triangles).
  const std::vector<Tet> tets = tets_inside(volume, threads);
  const auto [cuts, expected] = expected_work(volume, sizes, tets);
  if (cuts.part_count() == 1) return {};
  make_room(volume, expected);
  if (add_section_points(volume, cuts, sizes, threads, monitor) > tuning::kMostHugeOnCuts) return {};
  auto parts = cut_into_parts(volume, tets_inside(volume, threads), cuts, tuning::kMostAtFirstCuts, threads);
  if (!parts) return {};
  const FilledIn filled =
      fill_parts(*parts, sizes, Stage::field_points, {tuning::kWorkOnCuts, 1}, threads, monitor);
  return {std::move(parts), filled.stopped_early};
}

}  // namespace

FilledIn fill_parts(Parts& parts, const SizeFunction& sizes, Stage stage, std::array<double, 2> work,
                    const Threads& threads, Monitor& monitor) {
  std::vector<std::uint8_t> stopped(parts.parts().size());
  parallel_monitored(sizes.threads_of(threads), parts.parts().size(), monitor, work,
                     [&](std::size_t k, Monitor& own) {
                       Part& part = parts.parts()[k];
                       stopped[k] = advance_front(part.data(parts.whole()), sizes, stage, own);
                       part.order_along_curve();
                     });
  return {parts.new_vertices(), std::find(stopped.begin(), stopped.end(), 1) != stopped.end()};
}

FieldPoints add_field_points(const VolumeData& volume, const SizeFunction& sizes, const Threads& threads,
                             Monitor& monitor) {
  set_sizes_at_vertices(volume, sizes, threads, monitor);
  if (!sizes.has_metric()) restore_delaunay(volume, threads, monitor);
  if (FieldPoints filled = filled_parts(volume, sizes, threads, monitor); filled.parts) return filled;
  order_along_curve(volume);
  const bool stopped_early = advance_front(volume, sizes, Stage::field_points, monitor);
  order_along_curve(volume);
  return {nullptr, stopped_early};
}

bool join_filled(std::unique_ptr<Parts> parts, const SizeFunction& sizes, const Threads& threads,
                 Monitor& monitor) {
  bool stopped_early = false;
  while (parts) {
    parts = join_and_cut_again(*parts, threads);
    if (parts)
      stopped_early |= fill_parts(*parts, sizes, Stage::field_points, {1, 1}, threads, monitor).stopped_early;
  }
  return stopped_early;
}

}  // namespace holdfast
