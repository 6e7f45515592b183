// A user's program: fills a cube and checks what it got, with the public headers alone.
#include <holdfast/check.h>
#include <holdfast/holdfast.h>
#include <holdfast/io.h>

#include <iostream>

int main() {
  const std::vector<holdfast::Point> vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                                 {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const std::vector<holdfast::Triangle> facets = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7},
                                                  {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5},
                                                  {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  holdfast::Complex cube;
  cube.vertices = vertices;
  cube.facets = facets;
  const holdfast::Result result = holdfast::mesh(cube);
  std::cout << "holdfast " << holdfast::version() << ": " << result.volume.tetrahedra.size() << " tetrahedra "
            << result.message << '\n';
  return result.outcome == holdfast::Outcome::done && holdfast::check(cube, result.volume).holds() ? 0 : 1;
}
