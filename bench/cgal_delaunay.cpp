// Times CGAL's Delaunay triangulation of a TetGen .node file: insertion with its spatial sort, on one thread,
// or with TBB on several (which gives another order of the cells each time).
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <tbb/global_control.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <memory>
#include <vector>

#include "ready_memory.h"

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel>;
using ParallelStructure =
    CGAL::Triangulation_data_structure_3<CGAL::Triangulation_vertex_base_3<Kernel>,
                                         CGAL::Delaunay_triangulation_cell_base_3<Kernel>,
                                         CGAL::Parallel_tag>;
using ParallelDelaunay = CGAL::Delaunay_triangulation_3<Kernel, ParallelStructure>;

namespace {

using Points = std::vector<Kernel::Point_3>;

// Prints the seconds that `make` takes and the number of cells.
template <class Make>
void time_of(const Make& make) {
  ready_memory(kReadyMemory);
  const auto start = std::chrono::steady_clock::now();
  const auto delaunay = make();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::cout << "seconds " << seconds << " tetrahedra " << delaunay->number_of_finite_cells() << '\n';
}

void triangulate(const Points& points) {
  time_of([&] { return std::make_unique<Delaunay>(points.begin(), points.end()); });
}

void triangulate_in_parallel(const Points& points, int threads) {
  constexpr int kLockGrid = 50;  // cells per axis, as in CGAL's example
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  ParallelDelaunay::Lock_data_structure locks(CGAL::bbox_3(points.begin(), points.end()), kLockGrid);
  time_of([&] { return std::make_unique<ParallelDelaunay>(points.begin(), points.end(), &locks); });
}

}  // namespace

int main(int count, char** arguments) {
  const int threads = count == 3 ? std::atoi(arguments[2]) : 1;
  std::ifstream file(count == 2 || count == 3 ? arguments[1] : "");
  std::size_t vertices = 0, dimension = 0, attributes = 0, markers = 0, index = 0;
  if (!(file >> vertices >> dimension >> attributes >> markers) || attributes + markers != 0 || threads < 1) {
    std::cerr << "usage: cgal_delaunay FILE.node [THREADS] (without attributes and markers)\n";
    return 2;
  }
  Points points;
  for (double x, y, z; file >> index >> x >> y >> z;) points.emplace_back(x, y, z);
  if (threads == 1)
    triangulate(points);
  else
    triangulate_in_parallel(points, threads);
  return 0;
}
