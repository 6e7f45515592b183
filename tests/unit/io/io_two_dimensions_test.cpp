// Meshes of the plane in formats that tell two dimensions from three: SU2's, MFEM's and legacy DOLFIN's.
#include <gtest/gtest.h>

#include <algorithm>

#include "holdfast/plane.h"
#include "io_volumes.h"

namespace holdfast::io_two_dimensions_test {
namespace {

using namespace samples;

/// Two squares with a wall between them, of four triangles. One side of the boundary is no segment.
PlaneMesh rooms() {
  PlaneMesh mesh;
  mesh.points = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, -1.0 / 3 + 1}};
  mesh.triangles = {{0, 1, 5}, {1, 4, 5}, {1, 2, 3}, {1, 3, 4}};
  mesh.regions = {4, 4, 9, 9};
  mesh.segments = {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {1, 4}};
  mesh.segment_markers = {1, 1, 2, 1, 1, 7};
  mesh.names.facets = {{4, "water"}, {9, "sand"}};
  mesh.names.segments = {{1, "wall"}, {2, "outlet"}, {7, "between"}};
  return mesh;
}

std::vector<std::pair<Segment, int>> marked_segments(const Surface& surface) {
  std::vector<std::pair<Segment, int>> result;
  for (std::size_t i = 0; i < surface.segments.size(); ++i) {
    Segment s = surface.segments[i];
    std::sort(s.begin(), s.end());
    result.emplace_back(s, surface.segment_markers.empty() ? 0 : surface.segment_markers[i]);
  }
  std::sort(result.begin(), result.end());
  return result;
}

using Marked = std::vector<std::pair<Segment, int>>;
const Marked kBoundary{{{0, 1}, 1}, {{0, 5}, 0}, {{1, 2}, 1}, {{2, 3}, 2}, {{3, 4}, 1}, {{4, 5}, 1}};

void expect_points(const Surface& read, const PlaneMesh& mesh) {
  ASSERT_EQ(read.vertices.size(), mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    EXPECT_EQ(read.vertices[i], (Point{mesh.points[i][0], mesh.points[i][1], 0}));
}

TEST(TwoDimensions, Su2HasTrianglesAndTheBoundaryByMarkers) {
  const TemporaryFolder folder;
  const PlaneMesh mesh = rooms();
  write_plane(folder / "a.su2", mesh);
  const std::string text = get(folder / "a.su2");
  EXPECT_NE(text.find("NDIME= 2\nNELEM= 4\n5 0 1 5 0\n"), std::string::npos) << text;
  EXPECT_NE(text.find("MARKER_TAG= outlet\nMARKER_ELEMS= 1\n3 2 3\n"), std::string::npos) << text;
  const Surface read = read_surface(folder / "a.su2");
  expect_points(read, mesh);
  EXPECT_EQ(read.facets, mesh.triangles);
  EXPECT_EQ(marked_segments(read), kBoundary);
  EXPECT_EQ(read.names.segments, (std::map<int, std::string>{{1, "wall"}, {2, "outlet"}}));
  std::vector<std::string> told;
  for (const Remark& remark : not_held(folder / "a.su2", mesh)) told.push_back(remark.message);
  EXPECT_EQ(told, (std::vector<std::string>{
                      "2 regions are one zone in .su2, which has no place for them",
                      "1 segments inside are left out: markers of .su2 are for the boundary"}));
}

TEST(TwoDimensions, MfemHasRegionsAsAttributesAndSegmentsAsTheBoundary) {
  const TemporaryFolder folder;
  const PlaneMesh mesh = rooms();
  write_plane(folder / "a.mesh", mesh, as_format("mfem"));
  const std::string text = get(folder / "a.mesh");
  EXPECT_NE(text.find("dimension\n2\n\nelements\n4\n4 2 0 1 5\n"), std::string::npos) << text;
  EXPECT_NE(text.find("boundary\n7\n1 1 0 1\n"), std::string::npos) << text;
  EXPECT_NE(text.find("vertices\n6\n2\n0 0\n"), std::string::npos) << text;
  ReadOptions reading;
  reading.format = "mfem";
  const Surface read = read_surface(folder / "a.mesh", reading);
  expect_points(read, mesh);
  EXPECT_EQ(read.facets, mesh.triangles);
  EXPECT_EQ(read.facet_markers, mesh.regions);
  Marked all = kBoundary;
  all.push_back({{1, 4}, 7});
  std::sort(all.begin(), all.end());
  EXPECT_EQ(marked_segments(read), all);
  EXPECT_EQ(read.names.facets, mesh.names.facets);
  EXPECT_EQ(read.names.segments, mesh.names.segments);
}

TEST(TwoDimensions, DolfinHasTwoCoordinates) {
  const TemporaryFolder folder;
  const PlaneMesh mesh = rooms();
  write_plane(folder / "a.xml", mesh);
  const std::string text = get(folder / "a.xml");
  EXPECT_NE(text.find("celltype=\"triangle\" dim=\"2\""), std::string::npos) << text;
  EXPECT_EQ(text.find(" z="), std::string::npos) << text;
  expect_points(read_surface(folder / "a.xml"), mesh);
}

TEST(TwoDimensions, ASurfaceInSpaceHasThreeCoordinates) {
  const TemporaryFolder folder;
  PlaneMesh mesh = rooms();
  for (const PlanePoint& p : mesh.points) mesh.in_space.push_back({p[0], p[1], p[0]});
  mesh.points.clear();
  for (const char* name : {"a.su2", "a.mfem", "a.xml"}) {
    write_plane(folder / name, mesh);
    const Surface read = read_surface(folder / name);
    EXPECT_EQ(read.vertices, mesh.in_space) << name;
    std::vector<Triangle> triangles = read.facets, expected = mesh.triangles;
    for (std::vector<Triangle>* all : {&triangles, &expected}) {
      for (Triangle& t : *all) std::sort(t.begin(), t.end());
      std::sort(all->begin(), all->end());
    }
    EXPECT_EQ(triangles, expected) << name;
  }
}

TEST(TwoDimensions, ErrorsNameTheLine) {
  EXPECT_EQ(error("NDIME= 4\n", "a.su2"), "line 1: the dimension is neither 2 nor 3");
  EXPECT_EQ(error("NDIME= 2\nNPOIN= 1\n0\n", "a.su2"),
            "line 3: a point needs as many coordinates as NDIME= says before it");
  EXPECT_EQ(error("MFEM mesh v1.0\ndimension\n3\nvertices\n1\n2\n0 0\n", "a.mfem"),
            "line 6: the space's dimension is neither 3 nor that of the mesh");
}

}  // namespace
}  // namespace holdfast::io_two_dimensions_test
