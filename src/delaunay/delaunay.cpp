#include "delaunay/delaunay.h"

#include <cassert>
#include <stdexcept>
#include <string>
#include <utility>

#include "delaunay/number.h"
#include "delaunay/schedule.h"
#include "delaunay/triangulation.h"
#include "mesh/editor.h"
#include "mesh/parallel.h"

namespace holdfast {
namespace {

constexpr std::size_t kMostVertices = std::size_t{1} << 30;

// Calls take(triangulation) on the triangulation of points that are not coplanar.
template <class Take>
bool triangulate(std::span<const Point> points, std::uint64_t seed, const Threads& threads,
                 const InsertionProgress& progress, const Take& take) {
  if (points.size() > kMostVertices) throw std::length_error("holdfast: more than 2^30 points");
  Triangulation triangulation(points, insertion_order(points, seed, threads), threads);
  if (!triangulation.start()) return false;
  insert_all(triangulation, seed, threads, progress);
  take(triangulation);
  return true;
}

}  // namespace

bool build_delaunay(TetMesh& mesh, const DelaunayOrder& options, Monitor* monitor) {
  assert(mesh.tet_count() == 0 && mesh.exact_vertex_count() == 0);
  InsertionProgress progress;
  if (monitor != nullptr) progress = [&](double fraction) { monitor->poll(Stage::delaunay, fraction); };
  const auto take = [&](Triangulation& triangulation) {
    MeshEditor(mesh).load(all_cells(triangulation, options.threads));
  };
  return triangulate(mesh.positions(), options.seed, options.threads, progress, take);
}

std::vector<Tetrahedron> delaunay_of(std::span<const Point> points, std::uint64_t seed,
                                     const Threads& threads, const std::function<void(double)>& progress) {
  std::vector<Tetrahedron> tets;
  triangulate(points, seed, threads, progress,
              [&](Triangulation& triangulation) { tets = finite_cells(triangulation, threads); });
  return tets;
}

}  // namespace holdfast
