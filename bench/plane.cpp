// Times triangles in the plane: of a .poly, by the processor, in the memory that is there.
//
//   plane_times FILE.poly TURNS [ears|swaps|partition] [delaunay]     (with delaunay all within the hull is
//   kept)
#include "holdfast/plane.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "holdfast/names.h"
#include "ready_memory.h"

int main(int count, char** arguments) try {
  if (count < 3) {
    std::cerr << "usage: plane_times FILE.poly TURNS [ears|swaps|partition] [delaunay]\n";
    return 2;
  }
  const holdfast::Plane plane = holdfast::read_plane(arguments[1]);
  holdfast::PlaneOptions options;
  for (int i = 3; i < count; ++i) {
    if (const auto method = holdfast::from_name<holdfast::PlaneMethod>(arguments[i]))
      options.method = *method;
    options.delaunay = options.delaunay || std::string(arguments[i]) == "delaunay";
  }
  options.hull = options.delaunay;
  ready_memory(kReadyMemory);
  std::vector<double> seconds;
  std::size_t triangles = 0;
  for (int turn = 0; turn < std::atoi(arguments[2]); ++turn) {
    const std::clock_t start = std::clock();
    triangles = triangulate(plane, options).mesh.triangles.size();
    seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  if (triangles == 0) return 1;
  std::sort(seconds.begin(), seconds.end());
  std::cout << "seconds " << seconds[seconds.size() / 2] << " triangles " << triangles << '\n';
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
