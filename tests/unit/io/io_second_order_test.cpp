// Volumes of second order through every format that is read and written: nodes, markers and regions are the
// same.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "holdfast/check.h"
#include "holdfast/io.h"
#include "holdfast/second_order.h"

namespace holdfast::io_second_order_test {
namespace {

class SecondOrderFiles : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    volume_.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    volume_.tetrahedra = {{0, 1, 2, 3}, {1, 2, 3, 4}};
    volume_.regions = {5, 5};
    volume_.facets = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {2, 3, 4}, {1, 4, 3}, {1, 2, 4}};
    volume_.facet_markers = {3, 3, 3, 7, 7, 7};
    volume_.segments = {{0, 1}};
    volume_.segment_markers = {4};
    surface_.vertices = volume_.vertices;
    surface_.facets = volume_.facets;
    surface_.facet_markers = volume_.facet_markers;
    surface_.segments = volume_.segments;
    surface_.segment_markers = volume_.segment_markers;
    add_mid_nodes(volume_);
    folder_ = std::filesystem::path(::testing::TempDir()) / (std::string("second_order") + GetParam());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Surface surface_;
  Volume volume_;
  std::filesystem::path folder_;
};

TEST_P(SecondOrderFiles, ComeBack) {
  const std::filesystem::path path = folder_ / (std::string("a") + GetParam());
  write_volume(path, volume_);
  const Volume read = read_volume(path);
  ASSERT_EQ(read.vertices, volume_.vertices);
  ASSERT_EQ(read.tetrahedra.size(), volume_.tetrahedra.size());
  ASSERT_EQ(read.mid_nodes.points.size(), volume_.mid_nodes.points.size());
  const CheckResult checked = check(surface_.view(), read);
  EXPECT_EQ(checked.rules.size(), 15u);
  for (const Rule& rule : checked.rules) EXPECT_TRUE(rule.holds) << rule.name << ": " << rule.detail;
}

INSTANTIATE_TEST_SUITE_P(Formats, SecondOrderFiles,
                         ::testing::Values(".vtu", ".vtk", ".msh", ".mesh", ".meshb", ".node", ".vol"),
                         [](const auto& named) { return std::string(named.param).substr(1); });

/// Reads text as a volume of second order in Medit's format: a tetrahedron with nodes, and triangles and
/// edges without.
Volume read_linear_boundary(const std::string& boundary) {
  const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / "linear_boundary.mesh";
  std::ofstream(path) << "MeshVersionFormatted 2\nDimension 3\nVertices\n11\n"
                         "0 0 0 0\n2 0 0 0\n0 2 0 0\n0 0 2 0\n"
                         "1 0 0 0\n1 1 0 0\n0 1 0 0\n0 0 1 0\n1 0 1 0\n0 1 1 0\n5 5 5 0\n"
                         "TetrahedraP2\n1\n1 2 3 4 5 6 7 8 9 10 1\n"
                      << boundary << "End\n";
  Volume volume = read_volume(path);
  std::filesystem::remove(path);
  return volume;
}

TEST(LinearBoundary, HasTheNodesOfTheTetrahedra) {
  const Volume volume = read_linear_boundary("Triangles\n1\n4 2 1 3\nEdges\n1\n3 4 9\n");
  ASSERT_EQ(volume.mid_nodes.points.size(), 6u);
  const auto at = [&](Index node) { return volume.mid_nodes.points[node - volume.vertices.size()]; };
  ASSERT_EQ(volume.mid_nodes.facets.size(), 1u);
  EXPECT_EQ(at(volume.mid_nodes.facets[0][0]), (Point{1, 0, 1}));
  EXPECT_EQ(at(volume.mid_nodes.facets[0][1]), (Point{1, 0, 0}));
  EXPECT_EQ(at(volume.mid_nodes.facets[0][2]), (Point{0, 0, 1}));
  ASSERT_EQ(volume.mid_nodes.segments.size(), 1u);
  EXPECT_EQ(at(volume.mid_nodes.segments[0]), (Point{0, 1, 1}));
}

TEST(LinearBoundary, OffTheTetrahedraIsOfFirstOrder) {
  const Volume volume = read_linear_boundary("Edges\n1\n4 11 9\n");
  EXPECT_TRUE(volume.mid_nodes.points.empty());
  EXPECT_EQ(volume.vertices.size(), 5u);
}

/// Reads text as a surface of a format.
Surface read_text(const std::string& text, const std::string& ending) {
  const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / ("by_corners" + ending);
  std::ofstream(path) << text;
  Surface surface = read_surface(path);
  std::filesystem::remove(path);
  return surface;
}

void expect_corners(const Surface& surface, std::size_t left_out) {
  EXPECT_EQ(surface.vertices, (std::vector<Point>{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}));
  EXPECT_EQ(surface.facets, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  const std::string told = std::to_string(left_out) + " nodes that are no corners are left out";
  EXPECT_TRUE(std::any_of(surface.remarks.begin(), surface.remarks.end(),
                          [&](const Remark& r) { return r.message == told; }));
}

// A quadrangle of second order has no place in a mesh, and no element of higher order has.
TEST(ByCorners, QuadranglesOfSecondOrder) {
  const std::string nodes = "1 0 0 0\n2 2 0 0\n3 2 2 0\n4 0 2 0\n5 1 0 0\n6 2 1 0\n7 1 2 0\n8 0 1 0\n";
  expect_corners(read_text("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n" + nodes +
                               "$EndNodes\n$Elements\n1\n1 16 2 0 1 1 2 3 4 5 6 7 8\n$EndElements\n",
                           ".msh"),
                 4);
  for (const std::string type : {"S8R", "CAX8"})  // a shell, and axisymmetric
    expect_corners(read_text("*NODE\n1, 0, 0, 0\n2, 2, 0, 0\n3, 2, 2, 0\n4, 0, 2, 0\n5, 1, 0, 0\n6, 2, 1, 0\n"
                             "7, 1, 2, 0\n8, 0, 1, 0\n*ELEMENT, TYPE=" +
                                 type + "\n1, 1, 2, 3, 4, 5, 6, 7, 8\n",
                             ".inp"),
                   4);
  const std::string head =
      "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 9 float\n"
      "0 0 0 2 0 0 2 2 0 0 2 0 1 0 0 2 1 0 1 2 0 0 1 0 1 1 0\n";
  for (const char* type : {"28", "70"})  // biquadratic, and Lagrange's
    expect_corners(read_text(head + "CELLS 1 10\n9 0 1 2 3 4 5 6 7 8\nCELL_TYPES 1\n" + type + "\n", ".vtk"),
                   5);
}

TEST(ByCorners, TrianglesOfThirdOrder) {
  expect_corners(
      read_text("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n16\n1 0 0 0\n2 2 0 0\n3 2 2 0\n4 0 2 0\n"
                "5 .6 0 0\n6 1.4 0 0\n7 2 .6 0\n8 2 1.4 0\n9 1.4 1.4 0\n10 .6 .6 0\n11 1.4 .6 0\n"
                "12 1.4 2 0\n13 .6 2 0\n14 0 1.4 0\n15 0 .6 0\n16 .6 1.4 0\n$EndNodes\n$Elements\n2\n"
                "1 21 2 0 1 1 2 3 5 6 7 8 9 10 11\n2 21 2 0 1 1 3 4 10 9 12 13 14 15 16\n$EndElements\n",
                ".msh"),
      12);
}

}  // namespace
}  // namespace holdfast::io_second_order_test
