// Fills a surface file with tetrahedra and writes them: `fill_surface part.stl part.vtu`.
#include <holdfast/holdfast.h>
#include <holdfast/io.h>

#include <iostream>

int main(int count, char** arguments) try {
  if (count != 3) {
    std::cerr << "usage: fill_surface SURFACE VOLUME\n";
    return 2;
  }
  const holdfast::Surface surface = holdfast::read_surface(arguments[1]);

  holdfast::Options options;
  options.time_limit = 60;  // seconds
  const holdfast::Result result = holdfast::mesh(surface.view(), options);

  for (const holdfast::Defect& defect : result.defects) std::cerr << defect.message << '\n';
  if (result.outcome != holdfast::Outcome::done) {
    std::cerr << result.message << '\n';
    return 1;
  }
  holdfast::write_volume(arguments[2], result.volume);
  std::cout << result.volume.tetrahedra.size() << " tetrahedra, " << result.report.steiner_points
            << " added points\n";
  return 0;
} catch (const holdfast::FileError& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
