#include "delaunay/delaunay.h"

#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/insert.h"
#include "delaunay/order.h"
#include "mesh/validate.h"

namespace holdfast {
namespace {

constexpr std::size_t kMostVertices = std::size_t{1} << 30;
constexpr std::size_t kPollInterval = 64;

// Hands the kernel's cells over in the numbering of the mesh, freeing them on the way.
void hand_over(DelaunayKernel& kernel, TetMesh& mesh) {
  constexpr std::size_t kBlock = std::size_t{1} << 16;
  const CellStore& cells = kernel.cells();
  const std::vector<std::uint32_t>& order = kernel.order();
  std::vector<TetMesh::Corners> corners;
  std::vector<TetMesh::Neighbours> neighbours;
  corners.reserve(cells.size());
  neighbours.reserve(cells.size());
  advise_huge_pages(corners.data(), cells.size() * sizeof(TetMesh::Corners));
  advise_huge_pages(neighbours.data(), cells.size() * sizeof(TetMesh::Neighbours));
  for (std::size_t t = 0; t < cells.size(); ++t) {
    if (t % kBlock == 0) kernel.forget_first(t);
    const auto& v = cells[t].v;
    corners.push_back({order[v[0]], order[v[1]], order[v[2]], v[3] == kernel.ghost() ? kGhost : order[v[3]]});
    neighbours.push_back(cells[t].n);
  }
  mesh.set_tets(std::move(corners), std::move(neighbours));
}

}  // namespace

bool build_delaunay(TetMesh& mesh, const DelaunayOptions& options, Monitor* monitor) {
  if (mesh.vertex_count() > kMostVertices) throw std::length_error("holdfast: more than 2^30 points");
  assert(mesh.tet_count() == 0 && mesh.exact_vertex_count() == 0);
  DelaunayKernel kernel(mesh.positions(), insertion_order(mesh.positions(), options.seed), options.seed);
  if (!kernel.start()) return false;
  const auto count = static_cast<double>(kernel.size());
  for (std::size_t k = 4; k < kernel.size(); ++k) {
    if (monitor != nullptr && k % kPollInterval == 0)
      monitor->poll(Stage::delaunay, static_cast<double>(k) / count);
    kernel.insert(static_cast<Vertex>(k));
  }
  kernel.finish();
  hand_over(kernel, mesh);
#ifdef HOLDFAST_VALIDATE
  if (const std::string fault = find_fault(mesh); !fault.empty())
    throw std::logic_error("holdfast: " + fault);
#endif
  return true;
}

std::vector<Tetrahedron> delaunay(std::span<const Point> points, std::uint64_t seed) {
  TetMesh mesh;
  mesh.reserve(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& p = points[i];
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      throw std::invalid_argument("holdfast: point " + std::to_string(i) + " is not finite");
    mesh.add_vertex(p);
  }
  build_delaunay(mesh, {seed}, nullptr);
  std::vector<Tetrahedron> tets;
  for (Tet t = 0; t < mesh.slot_count(); ++t)
    if (mesh.alive(t) && !mesh.is_ghost(t)) tets.push_back(mesh.corners(t));
  return tets;
}

}  // namespace holdfast
