// LS-DYNA's keyword files.
#include <gtest/gtest.h>

#include "io_volumes.h"

namespace holdfast::io_dyna_test {
namespace {

using namespace samples;

const std::string kNodes =
    "*NODE\n"
    "$#   nid               x               y               z      tc      rc\n"
    "       1             0.0             0.0             0.0       0       0\n"
    "       2             1.0             0.0             0.0\n"
    "       3             0.0             1.0             0.0\n"
    "      40             0.0             0.0             1.0\n";

TEST(DynaFile, PartsAndSetsAreRegionsAndMarkers) {
  const Volume read =
      volume("*KEYWORD\n*TITLE\na title\n" + kNodes +
                 "*ELEMENT_SOLID\n$ a comment\n      11       7       1       2       3      40      40      "
                 "40      40"
                 "      40\n"
                 "*PART\nhousing, upper\n         7         1         1\n*MAT_ELASTIC\n1,2,3\n"
                 "*SET_SEGMENT_TITLE\ninlet\n         3       0.0\n         1         3         2         2\n"
                 "*SET_SEGMENT\n         4\n1, 2, 40\n2, 3, 40, 40\n3, 1, 40, 0\n"
                 "*SET_NODE_LIST_TITLE\ntip\n         9\n        40\n*END\n*NODE\nnonsense\n",
             "a.k");
  EXPECT_EQ(read.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}}));
  EXPECT_EQ(read.regions, (std::vector<int>{7}));
  EXPECT_EQ(read.names.regions, (std::map<int, std::string>{{7, "housing, upper"}}));
  EXPECT_EQ(read.facets, (std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}));
  EXPECT_EQ(read.facet_markers, (std::vector<int>{3, 4, 4, 4}));
  EXPECT_EQ(read.names.facets, (std::map<int, std::string>{{3, "inlet"}}));
  EXPECT_EQ(read.vertex_markers, (std::vector<int>{0, 0, 0, 9}));
  EXPECT_EQ(read.names.vertices, (std::map<int, std::string>{{9, "tip"}}));
}

/// The same nodes and element in the other widths of columns, with commas, and with blanks alone.
TEST(DynaFile, Columns) {
  const std::vector<std::string> files = {
      "*KEYWORD LONG=Y\n*NODE\n                   1                 0.0                 0.0                 "
      "0.0\n"
      "                   2                 1.5                 0.0                 0.0\n"
      "                   3                 0.0                 1.0                 0.0\n"
      "                  40                 0.0                 0.0                 1.0\n"
      "*ELEMENT_SOLID\n                  11                   7\n                   1                   2"
      "                   3                  40\n",
      "*KEYWORD I10=Y\n*NODE\n         1             0.0             0.0             0.0\n"
      "         2             1.5             0.0             0.0\n"
      "         3             0.0             1.0             0.0\n        40             0.0             0.0"
      "             1.0\n*ELEMENT_SOLID\n        11         7         1         2         3        40        "
      "40"
      "        40        40        40\n",
      "*KEYWORD\n*NODE +\n                   1                 0.0                 0.0                 0.0\n"
      "                   2                 1.5                 0.0                 0.0\n"
      "                   3                 0.0                 1.0                 0.0\n"
      "                  40                 0.0                 0.0                 1.0\n"
      "*ELEMENT_SOLID (ten nodes format)\n      11       7\n       1       2       3      40      40      40"
      "      40      40       0       0\n",
      "*node\n1,0,0,0\n2, 1.5 ,,\n3,0,1,0\n40,0,0,1\n*element_solid\n11,7,1,2,3,40\n",
      "*NODE\n1 0 0 0\n2 1.5 0 0\n3\t0\t1\t0\n40 0 0 1\n*ELEMENT_SOLID\n11 7\n1 2 3 40 40 40 40 40\n"};
  for (const std::string& file : files) {
    const Volume read = volume(file, "a.key");
    EXPECT_EQ(read.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}})) << file;
    EXPECT_EQ(read.regions, (std::vector<int>{7})) << file;
    EXPECT_EQ(read.vertices[1], (Point{1.5, 0, 0})) << file;
  }
}

TEST(DynaFile, OtherSolidsAreSplit) {
  std::string nodes = "*NODE\n";
  const std::vector<Point> cube = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                   {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  for (std::size_t i = 0; i < cube.size(); ++i)
    nodes += std::to_string(i + 1) + "," + std::to_string(cube[i][0]) + "," + std::to_string(cube[i][1]) +
             "," + std::to_string(cube[i][2]) + "\n";
  const auto six_volumes = [&](const std::string& element) {
    const Volume read = volume(nodes + "*ELEMENT_SOLID\n1,1," + element + "\n", "a.k");
    double sum = 0;
    for (const Tetrahedron& t : read.tetrahedra) {
      std::array<Point, 3> e{};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) e[i][k] = read.vertices[t[i + 1]][k] - read.vertices[t[0]][k];
      sum += e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
             e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
             e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    }
    return sum;
  };
  EXPECT_DOUBLE_EQ(six_volumes("1,2,3,4,5,6,7,8"), 6);
  EXPECT_DOUBLE_EQ(six_volumes("1,2,3,4,5,5,8,8"), 3);  // a prism
  EXPECT_DOUBLE_EQ(six_volumes("1,2,3,4,5,8"), 3);
  EXPECT_DOUBLE_EQ(six_volumes("1,2,3,4,5,5,5,5"), 2);  // a pyramid
  EXPECT_DOUBLE_EQ(six_volumes("1,2,3,4,5"), 2);
  EXPECT_DOUBLE_EQ(six_volumes("1,2,3,3,5,5,5,5"), 1);
}

TEST(DynaFile, SegmentsOnSidesOfHexahedraAndOnShells) {
  const std::string nodes = "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n";
  const std::string set = "*SET_SEGMENT\n5\n5,6,7,8\n";
  Volume read = volume(nodes + "*ELEMENT_SOLID\n1,1,1,2,3,4,5,6,7,8\n" + set, "a.k");
  EXPECT_EQ(read.facets, (std::vector<Triangle>{{4, 5, 6}, {4, 6, 7}}));
  EXPECT_EQ(read.facet_markers, (std::vector<int>{5, 5}));
  // The shell's own triangles are marked, whatever its diagonal; its part makes way for the set's number.
  read = volume(nodes + set + "*ELEMENT_SHELL\n1,5,6,7,8,5\n2,5,1,2,3\n", "a.k");
  EXPECT_EQ(read.facets.size(), 3U);
  EXPECT_EQ(read.facet_markers, (std::vector<int>{5, 5, 1}));
  EXPECT_EQ(read.names.facets, (std::map<int, std::string>{{1, "part 5"}}));
}

TEST(DynaFile, OptionsOfElements) {
  const Volume read =
      volume(kNodes +
                 "*ELEMENT_SHELL_THICKNESS\n       1       2       1       2       3\n             0.1       "
                 "      0.1\n"
                 "       2       2       1       2      40      40\n             0.1\n"
                 "*ELEMENT_SOLID_ORTHO\n       5       1       1       2       3      40      40      40     "
                 " 40      40\n"
                 "             1.0\n             2.0\n*ELEMENT_BEAM\n       9       8       1      40\n"
                 "*SET_NODE_LIST_GENERATE\n         6\n         2         3\n*SET_NODE_GENERAL\n1\nALL\n",
             "a.k");
  EXPECT_EQ(read.facets.size(), 2U);
  EXPECT_EQ(read.tetrahedra.size(), 1U);
  EXPECT_EQ(read.segments, (std::vector<Segment>{{0, 3}}));
  EXPECT_EQ(read.segment_markers, (std::vector<int>{8}));
  EXPECT_EQ(read.vertex_markers, (std::vector<int>{0, 6, 6, 0}));
}

TEST(DynaFile, IncludedFiles) {
  const TemporaryFolder folder;
  put(folder / "a.k", "*KEYWORD\n*INCLUDE\n$ nodes\nnodes +\n.k\nelements.k\n*SET_SEGMENT\n1\n1,2,3\n*END\n");
  put(folder / "nodes.k", "*KEYWORD\n" + kNodes + "*END\nrubbish\n");
  put(folder / "elements.k", "*ELEMENT_SOLID\n1,1,1,2,3,40\n");
  const Volume read = read_volume(folder / "a.k");
  EXPECT_EQ(read.tetrahedra.size(), 1U);
  EXPECT_EQ(read.facets.size(), 1U);
  EXPECT_EQ(files_of_surface(folder / "a.k").size(), 3U);
  put(folder / "elements.k", "*ELEMENT_SOLID\n1,1,1,2,x,40\n");
  try {
    static_cast<void>(read_volume(folder / "a.k"));
    FAIL();
  } catch (const FileError& failure) {
    EXPECT_EQ(failure.path().filename(), "elements.k");
    EXPECT_NE(std::string(failure.what()).find("line 2: expected a node's number, found 'x'"),
              std::string::npos);
  }
  put(folder / "elements.k", "*INCLUDE\na.k\n");
  EXPECT_NE(refusal_of([&] { return read_volume(folder / "a.k"); }).find("include each other"),
            std::string::npos);
}

TEST(DynaFile, ErrorsNameTheLine) {
  const auto with = [&](const std::string& more) { return error(kNodes + more, "a.k"); };
  EXPECT_EQ(error("hello\n", "a.k"), "line 1: expected a keyword, found 'hello'");
  EXPECT_EQ(error("*KEYWORD\n*END\n", "a.k"), "the file has no *NODE");
  EXPECT_EQ(with("*NODE\n       2             1.x\n"), "line 8: expected a coordinate, found '1.x'");
  EXPECT_EQ(with("*NODE\n       2             1.0\n"), "the node 2 occurs twice");
  EXPECT_EQ(with("*ELEMENT_SOLID\n1,1,1,2,3,4\n"), "line 8: the node 4 does not exist");
  EXPECT_EQ(with("*ELEMENT_SOLID\n1,1,1,2,3\n"), "line 8: a solid of 3 nodes");
  EXPECT_EQ(with("*ELEMENT_SOLID\n1,1\n"), "line 8: the element has no card of nodes");
  EXPECT_EQ(with("*ELEMENT_SHELL\n1,1,1,2\n"), "line 8: a shell of fewer than 3 nodes");
  EXPECT_EQ(with("*ELEMENT_SHELL\n1,&part,1,2,3\n"), "line 8: expected a part, found '&part'");
  EXPECT_EQ(with("*ELEMENT_SHELL_COMPOSITE\n1,1,1,2,3\n"),
            "line 7: *ELEMENT_SHELL with the option 'composite' is not read");
  EXPECT_EQ(with("*INCLUDE_TRANSFORM\na.k\n"), "line 7: *include_transform is not followed; *INCLUDE is");
  EXPECT_EQ(with("*INCLUDE\n*END\n"), "line 7: *INCLUDE without a file's name");
  EXPECT_EQ(with("*SET_SEGMENT_TITLE\ntop\n"), "line 8: the set has no number");
}

TEST(DynaFile, WritesWhatReadsBackBitForBit) {
  const TemporaryFolder folder;
  Volume original = sample_volume();
  original.segments.clear();
  original.segment_markers.clear();
  write_volume(folder / "a.k", original);
  const Volume read = read_volume(folder / "a.k");
  EXPECT_EQ(bits(read.vertices), bits(original.vertices));
  EXPECT_EQ(read.tetrahedra, original.tetrahedra);
  EXPECT_EQ(read.vertex_markers, (std::vector<int>{0, 3, -3, 0, 3, 2147483647}));
  original.tetrahedra.clear();
  original.regions.clear();
  write_volume(folder / "b.k", original);
  const Surface surface = read_surface(folder / "b.k");
  EXPECT_EQ(surface.facets, original.facets);
  EXPECT_EQ(surface.facet_markers, original.facet_markers);
}

}  // namespace
}  // namespace holdfast::io_dyna_test
