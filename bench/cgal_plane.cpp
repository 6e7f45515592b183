// Times, in processor time, CGAL's constrained Delaunay triangulation of a two-dimensional .poly without
// markers: points with its spatial sort, then the segments, which must not cross.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <ctime>
#include <fstream>
#include <iostream>
#include <utility>
#include <vector>

#include "ready_memory.h"

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Default, CGAL::No_constraint_intersection_tag>;

int main(int count, char** arguments) {
  std::ifstream file(count == 2 ? arguments[1] : "");
  std::size_t vertices = 0, dimension = 0, attributes = 0, markers = 0, index = 0;
  if (!(file >> vertices >> dimension >> attributes >> markers) || dimension != 2 ||
      attributes + markers != 0) {
    std::cerr << "usage: cgal_plane FILE.poly (of two dimensions, without attributes and markers)\n";
    return 2;
  }
  std::vector<Kernel::Point_2> points;
  for (std::size_t i = 0; i < vertices; ++i) {
    double x = 0, y = 0;
    file >> index >> x >> y;
    points.emplace_back(x, y);
  }
  std::size_t segments = 0;
  file >> segments >> markers;
  std::vector<std::pair<std::size_t, std::size_t>> ends;
  for (std::size_t i = 0; i < segments; ++i) {
    std::size_t a = 0, b = 0;
    file >> index >> a >> b;
    ends.emplace_back(a, b);
  }
  ready_memory(kReadyMemory);
  const std::clock_t start = std::clock();
  Triangulation triangulation;
  triangulation.insert_constraints(points.begin(), points.end(), ends.begin(), ends.end());
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::cout << "seconds " << seconds << " triangles " << triangulation.number_of_faces() << '\n';
  return 0;
}
