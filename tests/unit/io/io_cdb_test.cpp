// Archive files of Ansys MAPDL.
#include <gtest/gtest.h>

#include "io_volumes.h"

namespace holdfast::io_cdb_test {
namespace {

using namespace samples;

const std::string kNodes =
    "/PREP7\nET,1,185\nET,        2,SOLID187\nET,3,154\nNBLOCK,6,SOLID,       40,        5\n(3i9,6e21.13e3)\n"
    "        1        0        0\n        2        0        0 1.0000000000000E+000\n"
    "        3        0        0 0.0000000000000E+000 1.0000000000000E+000\n"
    "       40        0        0 0.0000000000000E+000 0.0000000000000E+000 1.0000000000000E+000\n"
    "        5        0        0 0.0000000000000E+000 0.0000000000000E+000-1.0000000000000E+000 90. 0. 0.\n"
    "N,R5.3,LOC,       -1,\n";
const std::string kElements =
    "EBLOCK,19,SOLID,        2,        2\n(19i9)\n"
    "        7        1        1        1        0        0        0        0        8        0        1"
    "        1        2        3        3       40       40       40       40\n"
    "        8        1        1        1        0        0        0        0        8        0        2"
    "        1        3        2        2        5        5        5        5\n       -1\n";

TEST(CdbFile, MaterialsAndComponents) {
  const Volume read =
      volume(kNodes + kElements +
                 "CMBLOCK,UPPER   ,ELEM,       1  ! users element component definition\n(8i10)\n"
                 "         1\nCMBLOCK,TOP,NODE,3\n(8i10)\n         2        -3        40\n"
                 "CMBLOCK,TIP,NODE,1\n(8i10)\n         5\nFINISH\n",
             "a.cdb");
  EXPECT_EQ(read.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}, {0, 2, 1, 4}}));
  EXPECT_EQ(read.vertices[4], (Point{0, 0, -1}));
  EXPECT_EQ(read.regions, (std::vector<int>{7, 8}));
  EXPECT_EQ(read.names.regions, (std::map<int, std::string>{{7, "UPPER"}}));
  EXPECT_EQ(read.facets, (std::vector<Triangle>{{1, 2, 3}}));  // the face with all its nodes in TOP
  EXPECT_EQ(read.names.facets, (std::map<int, std::string>{{1, "TOP"}}));
  EXPECT_EQ(read.vertex_markers, (std::vector<int>{0, 0, 0, 0, 1}));
  EXPECT_EQ(read.names.vertices, (std::map<int, std::string>{{1, "TIP"}}));
}

TEST(CdbFile, ComponentsOfOtherElementsAreRegionsOfTheirOwn) {
  std::string same = kElements;
  same.replace(same.find("        8        1"), 9, "        7");
  const Volume read = volume(kNodes + same +
                                 "CMBLOCK,LOWER,ELEM,1\n(8i10)\n         2\nCMBLOCK,ALL,ELEM,2\n(8i10)\n"
                                 "         1        -2\n",
                             "a.cdb");
  EXPECT_EQ(read.regions, (std::vector<int>{7, 1}));
  EXPECT_EQ(read.names.regions, (std::map<int, std::string>{{1, "LOWER"}, {7, "ALL"}}));
}

TEST(CdbFile, SurfaceElementsAndOtherTypes) {
  const Volume read = volume(
      kNodes + "ET,4,170\n" + kElements +
          "TYPE,3\nEBLOCK,10,,,        2\n(15i9)\n"
          "       11        1        1        3        0        1        3        2        2\n"
          "       12        1        1        3        0        1        2       40       40\n       -1\n"
          "TYPE,4\nEBLOCK,10,,,1\n(15i9)\n       13        1        1        3        0        1\n       "
          "-1\n",
      "a.cdb");
  EXPECT_EQ(read.facets, (std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}}));
  EXPECT_EQ(read.facet_markers, (std::vector<int>{3, 3}));
}

TEST(CdbFile, TetrahedraOfTenNodes) {
  std::string nodes = "ET,1,187\nET,2,186\nNBLOCK,6,SOLID,10,10\n(3i9,6e21.13e3)\n";
  const char* const places[] = {"0 0 0", "2 0 0", "0 2 0", "0 0 2", "1 0 0",
                                "1 1 0", "0 1 0", "0 0 1", "1 0 1", "0 1 1"};
  for (int i = 0; i < 10; ++i) {
    nodes += (i < 9 ? "        " : "       ") + std::to_string(i + 1) + "        0        0";
    for (const char c : {places[i][0], places[i][2], places[i][4]})
      nodes += std::string(" ") + c + ".0000000000000E+000";
    nodes += "\n";
  }
  nodes += "N,R5.3,LOC,       -1,\nEBLOCK,19,SOLID,1,1\n(19i9)\n";
  const std::string head = "        1        1        1        1        0        0        0        0";
  const Volume ten =
      volume(nodes + head +
                 "       10        0        1        1        2        3        4        5        6        7"
                 "        8\n        9       10\n       -1\n",
             "a.cdb");
  ASSERT_EQ(ten.mid_nodes.tetrahedra.size(), 1U);
  std::string twenty = head;
  twenty.replace(9, 9, "        2");
  const Volume of_hexahedron = volume(
      nodes + twenty +
          "       20        0        1        1        2        3        3        4        4        4        "
          "4\n"
          "        5        6        3        7        4        4        4        4        8        9"
          "       10       10\n       -1\n",
      "a.cdb");
  EXPECT_EQ(of_hexahedron.tetrahedra, ten.tetrahedra);
  EXPECT_EQ(of_hexahedron.mid_nodes.tetrahedra, ten.mid_nodes.tetrahedra);
  EXPECT_EQ(bits(of_hexahedron.mid_nodes.points), bits(ten.mid_nodes.points));
}

TEST(CdbFile, ErrorsNameTheLine) {
  const auto with = [&](const std::string& more) { return error(kNodes + more, "a.cdb"); };
  EXPECT_EQ(error("/PREP7\n", "a.cdb"), "the file has no NBLOCK");
  EXPECT_EQ(error("NBLOCK,6,SOLID\n", "a.cdb"),
            "line 2: the file ends where the format of a block is expected; it is truncated");
  EXPECT_EQ(error("NBLOCK,6,SOLID\nhello\n", "a.cdb"),
            "line 2: expected the format of a block, such as (3i9,6e21.13e3), found 'hello'");
  EXPECT_EQ(error("NBLOCK,6,SOLID\n(3i9)\n", "a.cdb"), "line 2: the format of NBLOCK has no real numbers");
  EXPECT_EQ(error("NBLOCK,6,SOLID\n(3i9,6e9.1)\n        1        0        0      1.x\n", "a.cdb"),
            "line 3: expected a coordinate, found '1.x'");
  EXPECT_EQ(error("NBLOCK,6,SOLID\n(3i9,6e9.1)\n        1\n", "a.cdb"),
            "line 4: the file ends where the end of NBLOCK, N,R5.3,LOC,-1 is expected; it is truncated");
  EXPECT_EQ(with("EBLOCK,19,SOLID\n(19i9)\n        7        9        1\n"),
            "line 15: the element type 9 does not exist");
  EXPECT_EQ(with("EBLOCK,19,SOLID\n(19i9)\n        7        1        1\n"), "line 15: an element of 0 nodes");
  std::string wrong = kElements;
  wrong.replace(wrong.find("       40"), 9, "       41");
  EXPECT_EQ(with(wrong), "line 15: the node 41 does not exist");
  wrong.replace(wrong.find("        8        0        1"), 9, "        7");
  EXPECT_EQ(with(wrong).substr(0, 8), "line 15:");
  EXPECT_EQ(with("CMBLOCK,A,NODE,99999999999\n(8i10)\n"),
            "line 13: a component of 99999999999 members, but only 7 bytes follow; the file is truncated or "
            "damaged");
  EXPECT_EQ(with("CMBLOCK,A,NODE,4\n(8i10)\n"),
            "line 15: the file ends where the members of a component is expected; it is truncated");
}

TEST(CdbFile, EverythingComesBack) {
  const TemporaryFolder folder;
  Volume original = sample_volume();
  original.regions = {3, 1, 2147};
  original.facet_markers = {5, 7};
  original.segment_markers = {4, 5, 9};
  original.vertex_markers = {0, 3, -3, 0, 3, 7};
  original.names = {{{5, "part"}, {7, "inlet"}}, {{3, "part"}}, {{9, "wire"}}, {{3, "tip"}}};
  write_volume(folder / "a.cdb", original);
  const Volume read = read_volume(folder / "a.cdb");
  EXPECT_EQ(bits(read.vertices), bits(original.vertices));
  EXPECT_EQ(read.tetrahedra, original.tetrahedra);
  EXPECT_EQ(read.facets, original.facets);
  EXPECT_EQ(read.segments, original.segments);
  EXPECT_EQ(read.regions, original.regions);
  EXPECT_EQ(read.facet_markers, original.facet_markers);
  EXPECT_EQ(read.segment_markers, original.segment_markers);
  EXPECT_EQ(read.vertex_markers, original.vertex_markers);
  original.names.facets[5] = "part_2";
  EXPECT_TRUE(read.names == original.names);
}

}  // namespace
}  // namespace holdfast::io_cdb_test
