// Nodes and elements that an .inp file makes of others: *NGEN, *NFILL and *ELGEN.
#include <gtest/gtest.h>

#include <algorithm>

#include "io_samples.h"

namespace holdfast::io_inp_generate_test {
namespace {

using namespace samples;

class InpGenerate : public ::testing::Test, protected AsInp {};

// A block of 4 x 2 x 2 bricks, 40 x 10 x 6: lines along x, planes of them, and the space between two planes.
constexpr const char* kBlock =
    "*NODE\n1, 0, 0, 0\n5, 40, 0, 0\n201, 0, 10, 0\n205, 40, 10, 0\n"
    "2001, 0, 0, 6\n2005, 40, 0, 6\n2201, 0, 10, 6\n2205, 40, 10, 6\n"
    "*NGEN, NSET=LOW0\n1, 5\n*Ngen, Nset=low1\n201, 205, 1\n"
    "*NGEN, NSET=HIGH0\n2001, 2005\n*NGEN, NSET=HIGH1\n2201, 2205\n"
    "*NFILL, NSET=LOW\nLOW0, LOW1, 2, 100\n*NFILL, NSET=HIGH\nhigh0, high1, 2, 100\n"
    "*NFILL\nLOW, HIGH, 2, 1000\n"
    "*ELEMENT, TYPE=C3D8, ELSET=SEED\n1, 1, 2, 102, 101, 1001, 1002, 1102, 1101\n"
    "*ELGEN, ELSET=BEAM\n1, 4, 1, 1, 2, 100, 10, 2, 1000, 100\n";

double sum_of_volumes(const Volume& v) {
  double sum = 0;
  for (const Tetrahedron& t : v.tetrahedra) {
    const auto d = [&](std::size_t i, std::size_t k) { return v.vertices[t[i]][k] - v.vertices[t[0]][k]; };
    sum += (d(1, 0) * (d(2, 1) * d(3, 2) - d(2, 2) * d(3, 1)) -
            d(1, 1) * (d(2, 0) * d(3, 2) - d(2, 2) * d(3, 0)) +
            d(1, 2) * (d(2, 0) * d(3, 1) - d(2, 1) * d(3, 0))) /
           6;
  }
  return sum;
}

TEST_F(InpGenerate, ABlockOfLinesPlanesAndBricks) {
  const Volume v = volume(kBlock);
  EXPECT_EQ(v.vertices.size(), 5u * 3 * 3);
  const auto has = [&](const Point& p) {
    return std::find(v.vertices.begin(), v.vertices.end(), p) != v.vertices.end();
  };
  EXPECT_TRUE(has({10, 0, 0}));
  EXPECT_TRUE(has({30, 5, 3}));
  EXPECT_NEAR(sum_of_volumes(v), 40 * 10 * 6, 1e-9);
  ASSERT_FALSE(v.regions.empty());
  EXPECT_EQ(v.names.regions.at(v.regions.back()), "BEAM");
}

TEST_F(InpGenerate, SetsOfNodesAreAscendingUnlessTheyAreMarked) {
  const std::string nodes = "*NODE\n1, 0\n2, 1\n11, 0, 1\n12, 1, 1\n*NSET, NSET=A\n1, 2\n";
  const std::string rest = "*NFILL\nA, B, 2, 100\n";
  const auto middle = [&](const std::string& set) { return volume(nodes + set + rest).vertices[4]; };
  EXPECT_EQ(middle("*NSET, NSET=B\n12, 11\n"), (Point{0, 0.5, 0}));
  EXPECT_EQ(middle("*NSET, NSET=B, UNSORTED\n12, 11\n"), (Point{0.5, 0.5, 0}));
  EXPECT_EQ(middle("*NSET, NSET=B, GENERATE\n11, 12, 1\n"), (Point{0, 0.5, 0}));
  EXPECT_EQ(middle("*NSET, NSET=C\n11\n*NSET, NSET=B\n12, C\n"), (Point{0, 0.5, 0}));
}

TEST_F(InpGenerate, WhatIsNotReadIsTold) {
  const std::string nodes = "*NODE, NSET=E\n1, 0, 0, 0\n9, 1, 0, 0\n";
  EXPECT_EQ(error(nodes + "*NGEN, LINE=C\n1, 9, 2, , 0, 0, 0\n"),
            "line 4: nodes on curves (*NGEN with LINE) are not read; only straight lines are");
  EXPECT_EQ(error(nodes + "*NGEN\n1, 9, 3\n"),
            "line 5: the increment 3 does not lead from the node 1 to the node 9");
  EXPECT_EQ(error(nodes + "*NGEN\n1, 8\n"), "line 5: the node 8 does not exist");
  EXPECT_EQ(error(nodes + "*NGEN\n1, 9, 4\n1, 9, 4\n"), "the node 5 occurs twice");
  EXPECT_EQ(error(nodes + "*NFILL\nE, F, 2\n"), "line 5: the set of nodes 'F' does not exist");
  EXPECT_EQ(error(nodes + "*NFILL, BIAS=0.5\nE, E, 2\n"),
            "line 4: *NFILL with bias is not read; only equal intervals are");
  EXPECT_EQ(error(nodes + "*ELGEN\n1, 2\n"),
            "line 5: the element 1, of which *ELGEN makes others, does not exist");
  EXPECT_EQ(error(nodes + "*ELEMENT, TYPE=T3D2\n1, 1, 9\n*ELGEN\n1, 3, 1\n"),
            "line 7: the node 2 does not exist");
}

TEST_F(InpGenerate, AShortFileDoesNotMakeMillions) {
  const std::string nodes = "*NODE\n1, 0, 0, 0\n900000001, 1, 0, 0\n";
  EXPECT_NE(error(nodes + "*NGEN\n1, 900000001\n").find("damaged or malicious"), std::string::npos);
  EXPECT_NE(
      error(nodes +
            "*ELEMENT, TYPE=T3D2\n1, 1, 900000001\n*ELGEN\n1, 100000, 0, 1, 100000, 0, 9, 100000, 0, 7\n")
          .find("damaged or malicious"),
      std::string::npos);
  EXPECT_NE(error(nodes + "*NFILL\nA, A, 2\n*NSET, NSET=A, GENERATE\n1, 900000001\n").find("does not exist"),
            std::string::npos);
}

TEST_F(InpGenerate, NumbersThatWouldOverflowAreRefused) {
  const std::string nodes = "*NODE, NSET=E\n1, 0, 0, 0\n3, 1, 0, 0\n";
  const std::string element = nodes + "*ELEMENT, TYPE=T3D2\n1, 1, 3\n", huge = "9223372036854775807";
  EXPECT_EQ(error(nodes + "*ELEMENT, TYPE=T3D2\n" + huge + ", 1, 3\n"),
            "line 5: a number of an element or node is out of range: " + huge);
  EXPECT_EQ(error(element + "*ELSET, ELSET=A, GENERATE\n" + huge + ", " + huge + "\n"),
            "line 7: the first element is out of range: " + huge);
  EXPECT_EQ(error(element + "*ELSET, ELSET=A, GENERATE\n1, 1, " + huge + "\n"),
            "line 7: a step is out of range: " + huge);
  EXPECT_EQ(error(nodes + "*NSET, NSET=A, GENERATE\n1, 3, " + huge + "\n*NFILL\nA, E, 2\n"),
            "line 5: a step is out of range: " + huge);
  EXPECT_EQ(error(nodes + "*NFILL\nE, E, 2, -" + huge + "\n"),
            "line 5: an increment is out of range: -" + huge);
  EXPECT_EQ(error(element + "*ELGEN\n1, 3, 1, " + huge + "\n"),
            "line 7: an increment of *ELGEN is out of range: " + huge);
}

}  // namespace
}  // namespace holdfast::io_inp_generate_test
