// Times CGAL's Delaunay triangulation of a TetGen .node file: insertion with its spatial sort, one thread.
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <chrono>
#include <fstream>
#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel>;

int main(int count, char** arguments) {
  std::ifstream file(count == 2 ? arguments[1] : "");
  std::size_t points = 0, dimension = 0, attributes = 0, markers = 0, index = 0;
  if (!(file >> points >> dimension >> attributes >> markers) || attributes + markers != 0) {
    std::cerr << "usage: cgal_delaunay FILE.node (without attributes and markers)\n";
    return 2;
  }
  std::vector<Kernel::Point_3> vertices;
  for (double x, y, z; file >> index >> x >> y >> z;) vertices.emplace_back(x, y, z);

  const auto start = std::chrono::steady_clock::now();
  const Delaunay delaunay(vertices.begin(), vertices.end());
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::cout << "seconds " << seconds << " tetrahedra " << delaunay.number_of_finite_cells() << '\n';
  return 0;
}
