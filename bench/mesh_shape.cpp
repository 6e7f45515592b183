// Shape of the tetrahedra of volume files, one line of JSON each: the same measure for every mesher.
#include <algorithm>
#include <array>
#include <cstdio>

#include "holdfast/io.h"
#include "mesh/quality.h"

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const holdfast::Volume volume = holdfast::read_volume(argv[i]);
    std::array<std::size_t, 4> below{};  // tetrahedra with an angle below 10, 20, 30, 40 degrees
    double least = 180;
    double most = 0;
    double sum = 0;
    for (const holdfast::Tetrahedron& t : volume.tetrahedra) {
      const auto& v = volume.vertices;
      const std::array<double, 6> angles = holdfast::dihedral_angles(v[t[0]], v[t[1]], v[t[2]], v[t[3]]);
      const double low = *std::min_element(angles.begin(), angles.end());
      least = std::min(least, low);
      most = std::max(most, *std::max_element(angles.begin(), angles.end()));
      sum += low;
      for (std::size_t k = 0; k < below.size(); ++k)
        if (!(low >= 10 * static_cast<double>(k + 1))) ++below[k];
    }
    const auto count = static_cast<double>(volume.tetrahedra.size());
    const auto percent = [&](std::size_t k) { return 100 * static_cast<double>(below[k]) / count; };
    std::printf(
        "{\"tetrahedra\": %zu, \"min_dihedral\": %.3f, \"max_dihedral\": %.3f, \"mean_min\": %.2f, "
        "\"below\": [%.4f, %.4f, %.4f, %.4f]}\n",
        volume.tetrahedra.size(), least, most, sum / count, percent(0), percent(1), percent(2), percent(3));
  }
  return 0;
}
