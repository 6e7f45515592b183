// Faces of AutoCAD's DXF.
#include <gtest/gtest.h>

#include "holdfast/plane.h"
#include "io_samples.h"

namespace holdfast::io_dxf_test {
namespace {

using namespace samples;

Surface surface(const std::string& bytes) {
  const TemporaryFolder folder;
  put(folder / "a.dxf", bytes);
  return read_surface(folder / "a.dxf");
}
std::string error(const std::string& bytes) {
  return refusal_of([&] { return surface(bytes); });
}

/// Groups on lines of their own, from words: "0 LINE 8 layer".
std::string lines(const std::string& words) {
  std::string result;
  for (const char c : words) result += c == ' ' ? '\n' : c;
  return result + "\n";
}
std::string file(const std::string& entities, const std::string& blocks = "") {
  return lines("0 SECTION 2 HEADER 9 $ACADVER 1 AC1009 0 ENDSEC 0 SECTION 2 BLOCKS" + blocks +
               " 0 ENDSEC 0 SECTION 2 ENTITIES" + entities + " 0 ENDSEC 0 EOF");
}
const std::string kFace = " 0 3DFACE 8 wall 10 0 20 0 30 0 11 1 21 0 31 0 12 0 22 1 32 0 13 0 23 1 33 0";

TEST(DxfFile, FacesOfLayers) {
  const Surface read = surface(file(kFace + " 0 3DFACE 8 roof 10 0 20 0 30 1 11 1 21 0 31 1 12 1 22 1 32 1 "
                                            "13 0 23 1 33 1 70 5 0 LINE 8 wall 10 0 20 0"));
  EXPECT_EQ(read.facets.size(), 3U);
  EXPECT_EQ(read.facet_markers, (std::vector<int>{1, 2, 2}));
  EXPECT_EQ(read.names.facets, (std::map<int, std::string>{{1, "wall"}, {2, "roof"}}));
  EXPECT_EQ(read.vertices.size(), 7U);
  EXPECT_EQ(read.remarks.front().message, "1 entity without faces ('LINE') is left out");
  const Surface one = surface(file(kFace));
  EXPECT_TRUE(one.facet_markers.empty());
  EXPECT_EQ(one.names.facets, (std::map<int, std::string>{{0, "wall"}}));
}

TEST(DxfFile, PolyfacePolygonMeshAndMesh) {
  const std::string polyface =
      " 0 POLYLINE 8 0 66 1 70 64 71 4 72 2 0 VERTEX 70 192 10 0 20 0 30 0 0 VERTEX 70 192 10 1 20 0 30 0 0 "
      "VERTEX 70 192 "
      "10 1 20 1 30 0 0 VERTEX 70 192 10 0 20 1 30 0 0 VERTEX 70 128 71 1 72 2 73 -3 0 VERTEX 70 128 71 -1 "
      "72 3 73 4 74 0 "
      "0 SEQEND";
  EXPECT_EQ(surface(file(polyface)).facets, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  std::string grid = " 0 POLYLINE 8 0 66 1 70 48 71 2 72 3";  // closed in columns
  for (const char* p : {"0 20 0", "1 20 0", "0 20 1", "0 20 0 30 2", "1 20 0 30 2", "0 20 1 30 2"})
    grid += std::string(" 0 VERTEX 70 64 10 ") + p;
  EXPECT_EQ(surface(file(grid + " 0 SEQEND")).facets.size(), 6U);
  EXPECT_EQ(surface(file(" 0 MESH 8 0 91 0 92 4 10 0 20 0 30 0 10 1 20 0 30 0 10 0 20 1 30 0 10 0 20 0 30 1 "
                         "93 8 90 3 90 0 "
                         "90 2 90 1 90 3 90 0 90 1 90 3 94 1 90 0 90 1"))
                .facets,
            (std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}}));
}

TEST(DxfFile, BlocksAreCopied) {
  const std::string block =
      " 0 BLOCK 8 0 2 B 10 1 20 0 30 0 0 3DFACE 8 0 10 1 20 0 30 0 11 2 21 0 31 0 12 1 22 1 32 0 0 "
      "3DFACE 8 own 10 1 20 0 30 1 11 2 21 0 31 1 12 1 22 1 32 1 0 ENDBLK";
  const Surface read = surface(
      file(" 0 INSERT 8 left 2 B 10 5 20 0 30 0 0 INSERT 8 right 2 B 10 0 20 7 30 0 41 2 42 2 43 -2 50 90",
           block));
  ASSERT_EQ(read.facets.size(), 4U);
  EXPECT_EQ(read.facet_markers, (std::vector<int>{2, 1, 3, 1}));
  EXPECT_EQ(read.names.facets, (std::map<int, std::string>{{1, "own"}, {2, "left"}, {3, "right"}}));
  EXPECT_EQ(read.vertices[1], (Point{6, 0, 0}));
  EXPECT_EQ(read.vertices[7], (Point{0, 9, 0}));   // turned and doubled
  EXPECT_EQ(read.facets[2], (Triangle{6, 8, 7}));  // mirrored
  EXPECT_EQ(read.vertices[9], (Point{0, 7, -2}));
  EXPECT_EQ(surface(file(" 0 INSERT 2 B 70 3 71 2 44 4 45 5", block)).facets.size(), 12U);
}

PlanesInSpace planes(const std::string& bytes, double arc_step = 0) {
  const TemporaryFolder folder;
  put(folder / "a.dxf", bytes);
  ReadOptions options;
  options.arc_step = arc_step;
  return read_planes(folder / "a.dxf", options);
}
std::size_t triangles(const std::string& bytes, double arc_step = 0) {
  return triangulate(planes(bytes, arc_step)).mesh.triangles.size();
}

const std::string kSquare =
    " 0 LWPOLYLINE 8 rim 90 4 70 1 10 0 20 0 10 4 20 0 10 4 20 4 10 0 20 4 0 LINE 8 cut 10 0 20 0 11 4 21 4";

TEST(DxfOutlines, LayersNameSegments) {
  const PlaneResult result = triangulate(planes(file(kSquare)));
  EXPECT_EQ(result.mesh.triangles.size(), 2U);
  EXPECT_EQ(result.mesh.names.segments, (std::map<int, std::string>{{1, "rim"}, {2, "cut"}}));
  std::vector<int> markers = result.mesh.segment_markers;
  std::sort(markers.begin(), markers.end());
  EXPECT_EQ(markers, (std::vector<int>{1, 1, 1, 1, 2}));
  // Faces and lines together; a block on layer 0 has the layer of its copy.
  const std::string block = " 0 BLOCK 2 B 0 LINE 8 0 10 1 20 0 11 1 21 1 0 ENDBLK";
  const PlanesInSpace copied =
      planes(file(kSquare + " 0 INSERT 8 rim 2 B 10 1 20 1 0 LINE 8 cut 10 9 20 9 11 8 21 9", block));
  EXPECT_EQ(copied.points.size(), 4U + 2U + 2U);  // each place once
  EXPECT_EQ(copied.points[6], (Point{2, 1, 0}));
  EXPECT_EQ(triangles(file(kFace + " 0 LINE 8 0 10 0 20 0 30 0 11 1 21 0 31 0")), 1U);
  EXPECT_EQ(triangles(file(
                " 0 POLYLINE 8 a 66 1 70 1 30 7 0 VERTEX 10 0 20 0 0 VERTEX 10 1 20 0 0 VERTEX 10 1 20 1 0 "
                "VERTEX 10 0 20 0 0 SEQEND")),
            1U);
}

TEST(DxfOutlines, OpenPolylinesAndPlanes) {
  EXPECT_EQ(
      triangles(file(" 0 LWPOLYLINE 90 3 70 0 10 0 20 0 10 1 20 0 10 1 20 1 0 LINE 10 1 20 1 11 0 21 0")),
      1U);
  // In a plane turned up: x of the plane is y, its y is z.
  const PlanesInSpace turned =
      planes(file(" 0 LWPOLYLINE 70 1 38 5 210 1 220 0 230 0 10 0 20 0 10 1 20 0 10 1 20 2"));
  EXPECT_EQ(turned.points, (std::vector<Point>{{5, 0, 0}, {5, 1, 0}, {5, 1, 2}}));
  const PlanesInSpace lifted =
      planes(file(" 0 POLYLINE 70 1 30 7 0 VERTEX 10 0 20 0 0 VERTEX 10 1 20 0 0 VERTEX 10 1 20 1 0 SEQEND"));
  EXPECT_EQ(lifted.points[2], (Point{1, 1, 7}));
}

TEST(DxfOutlines, ArcsAreDividedWhenAsked) {
  const std::string disc = file(" 0 LWPOLYLINE 70 1 10 0 20 0 42 1 10 2 20 0 42 1");  // two half circles
  EXPECT_EQ(refusal_of([&] { return planes(disc); }),
            "line 22: an arc (ARC, CIRCLE, ELLIPSE, SPLINE, or a bulge of a polyline); arcs are divided into "
            "straight pieces if "
            "an angle for these is given (arcs, in degrees)");
  const PlanesInSpace divided = planes(disc, 90);
  ASSERT_EQ(divided.points.size(), 4U);
  EXPECT_NEAR(divided.points[1][0], 1, 1e-15);
  EXPECT_NEAR(divided.points[1][1], -1, 1e-15);  // turns to the left
  EXPECT_NEAR(divided.points[3][1], 1, 1e-15);
  // A shallow arc of a large radius stays within its height.
  for (const Point& p : planes(file(" 0 LWPOLYLINE 70 1 10 0 20 0 42 1e-9 10 2 20 0 10 1 20 5"), 0.1).points)
    EXPECT_TRUE(p[1] >= -1.1e-9) << p[1];
  EXPECT_EQ(planes(file(" 0 CIRCLE 10 1 20 2 40 3"), 30).points.size(), 12U);
  EXPECT_EQ(planes(file(" 0 CIRCLE 10 1 20 2 40 3"), 90).points[1], (Point{1, 5, 0}));
  // Ends of arcs meet the lines to which they lead, although these are rounded.
  const std::string slot =
      " 0 LINE 10 0.70710678 20 0.70710678 11 -3 21 0 0 LINE 10 -3 20 0 11 0.70710678 21 -0.70710678 0 ARC "
      "10 0 20 0 40 1 "
      "50 315 51 45";
  EXPECT_EQ(triangles(file(slot), 45), 2U);
  EXPECT_EQ(refusal_of([&] { return planes(file(" 0 CIRCLE 40 -1"), 30); }),
            "line 22: an arc whose radius is negative, or whose numbers are not finite");
  EXPECT_EQ(planes(file(kSquare + " 0 CIRCLE 40 0"), 30).points.size(), 4U)
      << "a point, as CAD programs write";
  EXPECT_THROW(static_cast<void>(planes(disc, 0.01)), std::invalid_argument);
}

TEST(DxfOutlines, Ellipses) {
  // Twice as wide as high, about (1, 2); the parameter 90 degrees is the top.
  const std::string whole = " 0 ELLIPSE 10 1 20 2 11 4 21 0 40 0.5";
  const PlanesInSpace ellipse = planes(file(whole + " 41 0 42 6.283185"), 30);
  ASSERT_EQ(ellipse.points.size(), 12U);
  EXPECT_EQ(ellipse.points[0], (Point{5, 2, 0}));
  EXPECT_NEAR(ellipse.points[3][0], 1, 1e-6);
  EXPECT_NEAR(ellipse.points[3][1], 4, 1e-6);
  for (const Point& p : ellipse.points)
    EXPECT_NEAR((p[0] - 1) * (p[0] - 1) / 16 + (p[1] - 2) * (p[1] - 2) / 4, 1, 1e-12);
  EXPECT_EQ(triangles(file(whole), 30), 10U) << "without parameters it is whole";
  // Seen from below it turns the other way: the upper half ends on the left, and a line closes it.
  const std::string half =
      " 0 ELLIPSE 10 0 20 0 11 2 21 0 40 0.5 41 0 42 3.141592654 0 LINE 10 -2 20 0 11 2 21 0";
  EXPECT_EQ(triangles(file(half), 60), 2U);
  const PlanesInSpace below = planes(file(" 0 ELLIPSE 11 2 21 0 40 0.5 230 -1 41 0 42 3.141592654"), 90);
  EXPECT_NEAR(below.points[1][1], -1, 1e-8);
}

TEST(DxfOutlines, Splines) {
  // A quarter of the unit circle as a rational spline of degree 2, and two lines that close it.
  const std::string knots = " 40 0 40 0 40 0 40 1 40 1 40 1";
  const std::string controls = " 10 1 20 0 30 0 10 1 20 1 30 0 10 0 20 1 30 0";
  const std::string quarter = " 0 SPLINE 71 2" + knots + " 41 1 41 0.70710678118654757 41 1" + controls;
  const std::string sides = " 0 LINE 10 0 20 1 11 0 21 0 0 LINE 10 0 20 0 11 1 21 0";
  const PlanesInSpace sector = planes(file(quarter + sides), 15);
  ASSERT_GE(sector.points.size(), 8U);
  ASSERT_LE(sector.points.size(), 18U);
  EXPECT_EQ(sector.points.front(), (Point{1, 0, 0})) << "control points at the ends, bit for bit";
  std::size_t on_circle = 0;
  for (const Point& p : sector.points) on_circle += std::fabs(std::hypot(p[0], p[1]) - 1) < 1e-15 ? 1 : 0;
  EXPECT_EQ(on_circle, sector.points.size() - 1);
  EXPECT_GE(triangles(file(quarter + sides), 15), 6U);
  // A parabola, and knots inside that a bend of degree 1 has.
  const PlanesInSpace parabola =
      planes(file(" 0 SPLINE 71 2" + knots + " 10 -1 20 1 10 0 20 -1 10 1 20 1"), 10);
  for (const Point& p : parabola.points) EXPECT_NEAR(p[1], p[0] * p[0], 1e-15);
  const PlanesInSpace bend =
      planes(file(" 0 SPLINE 71 1 40 0 40 0 40 0.5 40 1 40 1 10 0 20 0 10 1 20 0 10 1 20 1"), 90);
  EXPECT_EQ(bend.points, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
  // Periodic, without a knot of full multiplicity: it ends where it begins, up to rounding.
  std::string periodic = " 0 SPLINE 70 3 71 2";
  for (int k = 0; k < 9; ++k) periodic += " 40 " + std::to_string(k);
  const char* corners[] = {" 10 1 20 0.1", " 10 0 20 1", " 10 -1 20 0.3", " 10 0 20 -1"};
  for (int k = 0; k < 6; ++k) periodic += corners[k % 4];
  const PlanesInSpace loop = planes(file(periodic), 20);
  EXPECT_EQ(loop.parts[0].plane.segments.size(), loop.points.size());
  EXPECT_GE(triangles(file(periodic), 20), 10U);
  // Nothing but rounding, and a spline that turns back.
  const std::string place = " 10 0.1 20 0.7";
  EXPECT_EQ(planes(file(kSquare + " 0 SPLINE 71 2" + knots + place + place + place), 0.1).points.size(), 4U);
  const std::string back = " 0 SPLINE 71 2" + knots + " 10 9 20 9 10 10 20 9 10 9 20 9";
  EXPECT_LE(planes(file(kSquare + back), 0.1).points.size(), 100U);
  const auto error = [&](const std::string& entity) {
    return refusal_of([&] { return planes(file(" 0 SPLINE" + entity), 10); });
  };
  EXPECT_EQ(error(" 71 3" + knots + controls), "line 22: a spline of degree 3 with 3 control points");
  EXPECT_EQ(error(" 71 2 40 0 40 1" + controls),
            "line 22: a spline with 2 knots, where its control points need 6");
  EXPECT_EQ(error(" 71 2 40 0 40 0 40 0 40 0 40 0 40 0" + controls),
            "line 22: a spline whose knots do not increase");
  EXPECT_EQ(error(" 71 2" + knots + " 41 1 41 0 41 1" + controls),
            "line 22: a spline with a weight that is not positive");
  EXPECT_EQ(error(" 71 2" + knots + " 41 1" + controls),
            "line 22: a spline with more or fewer weights than control points");
}

TEST(DxfOutlines, WhatIsNoLine) {
  EXPECT_EQ(planes(file(kSquare + " 0 SPLINE 8 rim")).remarks.front().message,
            "1 entity without faces or lines ('SPLINE') is left out");
  EXPECT_EQ(
      refusal_of([&] { return planes(file(" 0 TEXT")); }),
      "holds no faces or lines (3DFACE, MESH, polyface or polygon mesh, LINE, LWPOLYLINE, POLYLINE, ARC, "
      "CIRCLE, ELLIPSE, SPLINE), but 'TEXT'; export solids as meshes, or as STL");
  EXPECT_EQ(refusal_of([&] { return planes(file(" 0 POLYLINE 70 1 0 VERTEX 10 0 20 0" + kFace)); }),
            "line 22: the POLYLINE has no SEQEND; the file is truncated or damaged");
}

TEST(DxfFile, ErrorsNameTheLine) {
  EXPECT_EQ(error("AutoCAD Binary DXF\r\n\x1a"), "a binary DXF; save it as text");
  EXPECT_EQ(error("hello\n"), "line 1: expected the code of a group, found 'hello'");
  EXPECT_EQ(error("0\n"), "line 2: the file ends where the value of a group is expected; it is truncated");
  EXPECT_EQ(error("0\nEOF\n"), "no DXF: the file has no SECTION");
  EXPECT_EQ(error(lines("0 SECTION 2 ENTITIES")), "the file does not end with EOF; it is truncated");
  EXPECT_EQ(error(file(" 0 3DSOLID")),
            "holds no faces (3DFACE, MESH, polyface or polygon mesh), but '3DSOLID'; export "
            "solids as meshes, or as STL; `holdfast plane` fills outlines");
  EXPECT_EQ(error(file(" 0 3DFACE 10 0 20 0 11 1 21 x 12 1")), "line 30: expected a number, found 'x'");
  EXPECT_EQ(error(file(" 0 3DFACE 10 0 20 0 11 1 21 0")), "line 22: a 3DFACE of 2 corners");
  EXPECT_EQ(error(file(" 0 POLYLINE 70 64" + kFace)),
            "line 22: the POLYLINE has no SEQEND; the file is truncated or damaged");
  EXPECT_EQ(error(file(" 0 POLYLINE 70 64 0 VERTEX 70 128 71 1 72 2 73 3 0 SEQEND")),
            "line 26: a face names a vertex that is not among the 0 before it");
  EXPECT_EQ(error(file(" 0 POLYLINE 70 64 0 VERTEX 70 128 71 -9223372036854775808 0 SEQEND")),
            "line 26: a face of the vertex -9223372036854775808");
  EXPECT_EQ(error(file(" 0 POLYLINE 70 16 71 2 72 30000 0 SEQEND")),
            "line 22: a polygon mesh of 2 times 30000 points, but with 0");
  EXPECT_EQ(error(file(" 0 MESH 93 2 90 4000000000 90 1")),
            "line 22: a face of 4000000000 corners in a MESH");
  EXPECT_EQ(error(file(" 0 INSERT 2 B")), "line 22: the block 'B' does not exist");
  const std::string itself = " 0 BLOCK 2 B 0 INSERT 2 B 0 ENDBLK";
  EXPECT_EQ(error(file(" 0 INSERT 2 B", itself)), "line 20: blocks that contain each other");
  std::string doubled = " 0 BLOCK 2 B0" + kFace + " 0 ENDBLK";
  for (int i = 1; i < 60; ++i) {
    const std::string twice = " 0 INSERT 2 B" + std::to_string(i - 1);
    doubled += " 0 BLOCK 2 B" + std::to_string(i) + twice + twice + " 0 ENDBLK";
  }
  EXPECT_NE(error(file(" 0 INSERT 2 B59", doubled)).find("damaged or malicious"), std::string::npos);
  EXPECT_NE(error(file(" 0 INSERT 2 B0 70 9000000000 71 9000000000", doubled)).find("damaged or malicious"),
            std::string::npos);
}

}  // namespace
}  // namespace holdfast::io_dxf_test
