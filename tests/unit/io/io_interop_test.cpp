// Other programs read the volumes that Holdfast writes: VTK (hence ParaView), meshio and Gmsh, if they are
// installed.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "io_samples.h"

namespace holdfast::io_interop_test {
namespace {

using namespace samples;

template <std::size_t N>
std::string json(const std::vector<std::array<Index, N>>& entities, const std::vector<int>& tags) {
  std::vector<std::pair<std::array<Index, N>, int>> sorted;
  for (std::size_t i = 0; i < entities.size(); ++i) sorted.emplace_back(entities[i], tags[i]);
  std::sort(sorted.begin(), sorted.end());
  std::string text;
  for (const auto& [corners, tag] : sorted) {
    std::string list;
    for (const Index corner : corners) list += (list.empty() ? "" : ", ") + std::to_string(corner);
    text += (text.empty() ? "[[" : ", [[") + list + "], " + std::to_string(tag) + "]";
  }
  return "[" + text + "]";
}

/// A coordinate as Python's float.hex writes it.
std::string hex(double x) {
  char text[40];
  if (x == 0) return std::signbit(x) ? "-0x0.0p+0" : "0x0.0p+0";
  std::snprintf(text, sizeof text, "%.13a", x);
  return text;
}

/// Four tetrahedra of positive volume round a segment, with facets, in two regions.
Volume volume() {
  Volume volume;
  volume.vertices = {{0.1, -0.0, 0}, {0.1, 0, 1.0 / 3}, {1, 0, 0},
                     {0, 1, 0},      {-1, 1e-300, 0},   {0, -1, 1e-17}};
  volume.tetrahedra = {{0, 1, 2, 3}, {0, 1, 3, 4}, {0, 1, 4, 5}, {0, 1, 5, 2}};
  volume.regions = {2, 1, 1, 2};
  volume.facets = {{0, 1, 3}, {1, 0, 5}};
  volume.facet_markers = {40, 7};
  volume.segments = {{1, 0}};
  volume.segment_markers = {3};
  volume.vertex_markers = {0, 5, 0, 8, 0, 8};
  return volume;
}

TEST(Interop, OtherProgramsReadTheSame) {
  const TemporaryFolder folder;
  const Volume original = volume();
  for (const char* name : {"volume.vtk", "volume.mesh", "volume.msh"}) write_volume(folder / name, original);
  WriteOptions whole;
  whole.one_file = true;
  write_volume(folder / "volume.vtu", original, whole);
  whole.compress = false;
  write_volume(folder / "volume_raw.vtu", original, whole);
  WriteOptions binary;
  binary.binary = true;
  write_volume(folder / "volume_binary.msh", original, binary);
  binary.legacy_msh = true;
  write_volume(folder / "volume_binary_22.msh", original, binary);
  write_volume(folder / "volume_22.msh", original, legacy_msh());
  std::string points;
  for (const Point& point : original.vertices)
    for (const double x : point) points += (points.empty() ? "\"" : ", \"") + hex(x) + "\"";
  put(folder / "expected.json",
      "{\"points\": [" + points + "], \"tetrahedra\": " + json(original.tetrahedra, original.regions) +
          ", \"facets\": " + json(original.facets, original.facet_markers) + ", \"segments\": " +
          json(original.segments, original.segment_markers) + ", \"vertex_markers\": [0, 5, 0, 8, 0, 8]}");
  const std::string script = HOLDFAST_SOURCE_DIR "/tests/unit/io/io_interop.py";
  int worst = 77 << 8;
  // The system's Python has the packages more often than the user's.
  for (const char* python : {"/usr/bin/python3", "python3"}) {
    worst = std::system((std::string(python) + " '" + script + "' '" + folder.path().string() + "'").c_str());
    if (WIFEXITED(worst) && WEXITSTATUS(worst) != 77 && WEXITSTATUS(worst) != 127) break;
  }
  if (WEXITSTATUS(worst) == 77 || WEXITSTATUS(worst) == 127)
    GTEST_SKIP() << "none of VTK, meshio and Gmsh is installed";
  EXPECT_EQ(worst, 0);
}

}  // namespace
}  // namespace holdfast::io_interop_test
