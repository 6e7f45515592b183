// Surfaces of the GTS library.
#include <gtest/gtest.h>

#include "holdfast/surface_io.h"
#include "io_samples.h"

namespace holdfast::io_gts_test {
namespace {

using namespace samples;

Surface surface(const std::string& bytes) {
  const TemporaryFolder folder;
  put(folder / "a.gts", bytes);
  return read_surface(folder / "a.gts");
}
std::string error(const std::string& bytes) {
  return refusal_of([&] { return surface(bytes); });
}

const std::string kHead =
    "# made by hand\n5 7 2 GtsSurface GtsFace GtsEdge GtsVertex\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n5 5 5 0.1\n";
const std::string kEdges = "1 2\n2 3\n3 1\n4 1\n2 4\n3 4\n5 4\n";

TEST(GtsFile, FacesTurnAsTheirEdges) {
  for (const std::string& edges : {kEdges, std::string("2 1\n3 2\n1 3\n1 4\n4 2\n3 4\n5 4\n")}) {
    const Surface read = surface(kHead + edges + "1 2 3 7\n1 4 5\n");
    // The other end of the first edge, the common vertex, the other end of the second.
    EXPECT_EQ(read.facets, (std::vector<Triangle>{{0, 1, 2}, {1, 0, 3}}));
    EXPECT_EQ(read.facet_markers, (std::vector<int>{7, 0}));
    EXPECT_EQ(read.segments.size(), 2U);
    EXPECT_EQ(read.vertices[4], (Point{5, 5, 5}));
  }
}

TEST(GtsFile, ErrorsNameTheLine) {
  EXPECT_EQ(error("3 3\n").substr(0, 7), "line 1:");
  EXPECT_EQ(error("4000000000 3 1\n0 0 0\n").substr(0, 7), "line 1:");
  EXPECT_EQ(error("3 0 0 GtsSurface GtsFace GtsEdge GtsVertexBinary\n                    "),
            "line 1: binary files are not read; save it as text");
  EXPECT_EQ(error(kHead + "1 2\n2 3\n3 1\n4 1\n2 4\n3 4\n9 4\n1 2 3\n1 4 5\n"),
            "line 14: a vertex is out of range: 9 (they run from 1 to 5)");
  EXPECT_EQ(error(kHead + kEdges + "1 2 3\n1 4 8\n"),
            "line 16: an edge is out of range: 8 (they run from 1 to 7)");
  EXPECT_EQ(error(kHead + kEdges + "1 2 3\n1 4 6\n"), "line 16: the three edges of a face are no triangle");
  EXPECT_EQ(error(kHead + kEdges + "1 2 3\n1 1 1\n"), "line 16: the three edges of a face are no triangle");
}

TEST(GtsFile, ComesBack) {
  const TemporaryFolder folder;
  Surface original = surface(kHead + kEdges + "1 2 3 7\n1 4 5\n");
  original.vertices[1] = {0.1, -0.0, 1e-300};
  write_surface(folder / "b.gts", original);
  const Surface read = read_surface(folder / "b.gts");
  EXPECT_EQ(bits(read.vertices), bits(original.vertices));
  EXPECT_EQ(read.facets, original.facets);
  EXPECT_EQ(read.facet_markers, original.facet_markers);
  EXPECT_EQ(read.segments, (std::vector<Segment>{{2, 3}, {3, 4}}));
}

}  // namespace
}  // namespace holdfast::io_gts_test
