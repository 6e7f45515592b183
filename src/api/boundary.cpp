#include "api/boundary.h"

#include <stdexcept>
#include <utility>

#include "api/scale.h"
#include "classify/open_interface.h"
#include "delaunay/box.h"
#include "delaunay/delaunay.h"
#include "holdfast/region_bounds.h"
#include "mesh/editor.h"
#include "recover/recover.h"
#include "suppress/suppress.h"

namespace holdfast {
namespace {

constexpr double kHiddenMargin = 0.5;    // of the box that is removed again, in extents of the complex
constexpr std::size_t kTetsAVertex = 7;  // of a Delaunay mesh, to reserve memory

std::vector<Vertex> points_inside(const Attempt& attempt, const BoxMesh& box, const Division& division) {
  const TetMesh& mesh = box.mesh;
  if (mesh.vertex_count() == box.first_free) return {};
  std::vector<bool> inside(mesh.vertex_count(), false);
  const std::vector<Tet> tets = division.tets(mesh);
  attempt.threads.poll();
  for (const Tet t : tets)
    for (const Vertex v : mesh.corners(t)) inside[v] = true;
  std::vector<Vertex> points;
  for (Vertex v = box.first_free; v < mesh.vertex_count(); ++v)
    if (inside[v]) points.push_back(v);
  return points;
}

}  // namespace

std::vector<Tet> Division::tets(const TetMesh& mesh) const {
  std::vector<Tet> tets;
  for (Tet t = 0; t < mesh.slot_count(); ++t)
    if (has(mesh, t)) tets.push_back(t);
  return tets;
}

BoxMesh delaunay_in_box(const Attempt& attempt) {
  const Complex& complex = attempt.complex();
  const int scale = choose_scale(complex.vertices);
  const exact::DoubleGrid grid = grid_after(scale);
  BoxMesh box;
  box.scale = scale;
  MeshEditor editor(box.mesh);
  editor.reserve(complex.vertices.size() + 8, kTetsAVertex * complex.vertices.size());
  for (const Point& p : complex.vertices) editor.add_vertex(scaled(p, scale));
  const double margin = attempt.options.keep == Keep::box ? attempt.options.box_margin : kHiddenMargin;
  for (const Point& corner : box_corners(box.mesh.positions(), margin, grid)) editor.add_vertex(corner);
  editor.set_grid(grid);
  box.first_free = static_cast<Vertex>(box.mesh.vertex_count());
  if (!build_delaunay(box.mesh, {attempt.seed, attempt.threads}, &attempt.monitor))
    throw std::logic_error("holdfast: the box has no tetrahedra");
  box.standing = mark_present(box.mesh, attempt.input.table(), attempt.threads);
  return box;
}

void recover_by_flips(const Attempt& attempt, BoxMesh& box) {
  const auto tell = [&](double part) { attempt.monitor.poll(Stage::flips, part); };
  FlipRecovery(box.mesh, {attempt.input.table(), attempt.complex().facets, box.standing}, attempt.seed)
      .run(tell);
}

EnforceStats enforce_missing(const Attempt& attempt, BoxMesh& box) {
  const bool eliminate = attempt.options.stop_after != Stage::partition;
  Standing standing = box.standing;
  EnforceStats stats =
      enforce(box.mesh, {attempt.input.table(), attempt.complex().facets, standing}, box.first_free,
              {.seed = attempt.seed,
               .flips = attempt.options.flips,
               .eliminate = eliminate,
               .order = attempt.options.order},
              attempt.monitor);
  if (eliminate)
    box.standing = std::move(standing);
  else
    box.pieces = std::move(stats.pieces);
  return stats;
}

Division divide(const Attempt& attempt, BoxMesh& box) {
  Division division;
  division.regions = find_regions(box.mesh, attempt.complex().facets, attempt.threads);
  const Options& options = attempt.options;
  const PartsOfComplex* const parts = attempt.input.parts();
  std::vector<RegionSeed> seeds = options.regions;
  if (parts != nullptr) seeds.resize(parts->seeds);
  std::erase_if(seeds, is_bound_alone);
  const Wanted wanted{options.keep, options.holes, seeds, options.drop_outside, parts};
  division.kept = choose_regions(box.mesh, division.regions, attempt.named_complex(), wanted, box.scale);
  return division;
}

void report_choice(const Attempt& attempt, BoxMesh& box, const Division& division, Result& result) {
  const Kept& kept = division.kept;
  result.report.keep = kept.rule;
  if (kept.conflict) result.report.turned_facets.assign(kept.conflict->begin(), kept.conflict->end());
  if (!kept.turned.empty()) {
    result.report.turned_facets = kept.turned;
    result.warnings.push_back(warn_of_turned(attempt.complex(), kept.turned));
  }
  for (Warning& warning : find_open_interfaces(box.mesh, division.regions, kept, attempt.named_complex(),
                                               [&] { attempt.monitor.poll(Stage::classify, 1); }))
    result.warnings.push_back(std::move(warning));
}

std::size_t suppress_points(const Attempt& attempt, BoxMesh& box, Division& division) {
  std::vector<Vertex> points = points_inside(attempt, box, division);
  if (points.empty()) return 0;
  suppress(box.mesh, std::move(points), box.first_free, attempt.monitor, attempt.seed);
  find_regions_again(box.mesh, attempt.complex().facets, division.regions, attempt.threads);
  return points_inside(attempt, box, division).size();
}

}  // namespace holdfast
