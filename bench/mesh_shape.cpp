// Shape of the tetrahedra of volume files, one line of JSON each: the same measure for every mesher.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "holdfast/io.h"
#include "mesh/quality.h"
#include "numbers/vector.h"

namespace {

constexpr double kMostQ = 1e6;  // so that one flat element does not dominate the mean
// In degrees: an angle this close to 10, 20 or 30 is not below it. Boxes have many round angles.
constexpr double kRoundAngle = 1e-6;

bool is_finite(const holdfast::Point& p) {
  return std::all_of(p.begin(), p.end(), [](double x) { return std::isfinite(x); });
}

// A peer's file with a vertex that is not finite has no mesh.
holdfast::Volume read(const char* file) {
  holdfast::Volume volume = holdfast::read_volume(file);
  if (!std::all_of(volume.vertices.begin(), volume.vertices.end(), is_finite)) volume.tetrahedra.clear();
  return volume;
}

}  // namespace

int main(int argc, char** argv) {
  using holdfast::operator-;
  for (int i = 1; i < argc; ++i) {
    const holdfast::Volume volume = read(argv[i]);
    std::array<std::size_t, 4> below{};  // tetrahedra with an angle below 10, 20, 30, 40 degrees
    double least = 180;
    double most = 0;
    double sum = 0, sum_of_q = 0, worst_q = 0, whole = 0;
    std::size_t not_positive = 0;
    std::array<double, 3> volume_below{};  // the same in volume, up to 30 degrees
    for (const holdfast::Tetrahedron& t : volume.tetrahedra) {
      const auto& v = volume.vertices;
      const std::array<double, 6> angles = holdfast::dihedral_angles(v[t[0]], v[t[1]], v[t[2]], v[t[3]]);
      // Angles of a null element may be NaN.
      const bool is_null = std::any_of(angles.begin(), angles.end(), [](double x) { return std::isnan(x); });
      const double low = is_null ? 0 : *std::min_element(angles.begin(), angles.end());
      least = std::min(least, low);
      most = is_null ? 180 : std::max(most, *std::max_element(angles.begin(), angles.end()));
      sum += low;
      const double six_volumes =
          holdfast::dot(v[t[1]] - v[t[0]], holdfast::cross(v[t[2]] - v[t[0]], v[t[3]] - v[t[0]]));
      const double q = holdfast::quality(v[t[0]], v[t[1]], v[t[2]], v[t[3]]);
      sum_of_q += std::min(q, kMostQ);
      worst_q = std::max(worst_q, std::isfinite(q) ? q : std::numeric_limits<double>::max());
      whole += six_volumes;
      if (!(six_volumes > 0)) ++not_positive;
      for (std::size_t k = 0; k < below.size(); ++k) {
        if (low >= 10 * static_cast<double>(k + 1) - kRoundAngle) continue;
        ++below[k];
        if (k < volume_below.size()) volume_below[k] += six_volumes;
      }
    }
    for (double& x : volume_below) x *= whole != 0 ? 100 / whole : 0;
    // Some programs write files without elements, and JSON cannot express their means.
    const auto count = static_cast<double>(std::max<std::size_t>(volume.tetrahedra.size(), 1));
    const auto percent = [&](std::size_t k) { return 100 * static_cast<double>(below[k]) / count; };
    std::printf(
        "{\"tetrahedra\": %zu, \"min_dihedral\": %.6g, \"max_dihedral\": %.3f, \"mean_min\": %.2f, "
        "\"below\": [%.4f, %.4f, %.4f, %.4f], \"volume_below\": [%.4f, %.4f, %.4f], \"mean_q\": %.8g, "
        "\"worst_q\": %.8g, \"volume\": %.17g, \"not_positive\": %zu}\n",
        volume.tetrahedra.size(), least, most, sum / count, percent(0), percent(1), percent(2), percent(3),
        volume_below[0], volume_below[1], volume_below[2], sum_of_q / count, worst_q, whole / 6,
        not_positive);
  }
  return 0;
}
