// What each reader accepts: the variants of its format, and the errors that name the line.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/formats.h"
#include "io_samples.h"
#include "surface/weld.h"

namespace holdfast::io_readers_test {
namespace {

using namespace samples;
using Facets = std::vector<Triangle>;
using Segments = std::vector<Segment>;

Surface surface(const std::string& bytes, const std::string& name) {
  const TemporaryFolder folder;
  put(folder / name, bytes);
  return read_surface(folder / name);
}

Volume volume(const std::string& bytes, const std::string& name) {
  const TemporaryFolder folder;
  put(folder / name, bytes);
  return read_volume(folder / name);
}

/// The place and reason of the error that reading gives, without the path.
std::string error(const std::string& bytes, const std::string& name) {
  const TemporaryFolder folder;
  put(folder / name, bytes);
  try {
    static_cast<void>(read_surface(folder / name));
  } catch (const FileError& failure) {
    const std::string what = failure.what();
    const std::size_t prefix = failure.path().string().size() + 2;
    EXPECT_EQ(failure.path().parent_path(), folder.path());
    return what.substr(prefix);
  }
  return "read";
}

TEST(Off, FacesSegmentsAndPoints) {
  const Surface s = surface(kOff, "a.off");
  EXPECT_EQ(s.vertices.size(), 5u);
  EXPECT_EQ(s.facets, (Facets{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}));
  EXPECT_EQ(s.segments, (Segments{{0, 4}}));
  EXPECT_EQ(s.vertices[4], (Point{-1, -1, -0.5}));
  EXPECT_TRUE(s.facet_markers.empty());
}

TEST(Off, Variants) {
  const Facets facets = surface(kOff, "a.off").facets;
  EXPECT_EQ(surface(replaced(kOff, "\n", "\r\n"), "a.off").facets, facets);
  EXPECT_EQ(surface(replaced(kOff, "\n", "\r"), "a.off").facets, facets);
  EXPECT_EQ(surface("\xEF\xBB\xBF" + std::string(kOff), "a.OFF").facets, facets);
  EXPECT_EQ(surface(replaced(kOff, "OFF\n", ""), "a.off").facets, facets);
  EXPECT_EQ(surface(replaced(kOff, "OFF\n# a comment\n", "OFF "), "a.off").facets, facets);
  EXPECT_EQ(surface(replaced(kOff, "5 6 0", "5 6"), "a.off").facets, facets);
  EXPECT_EQ(surface(replaced(kOff, " 0\n", "\t0 \n\n"), "a.off").facets, facets);
  for (const char* header : {"COFF\n", "NOFF\n", "CNOFF\n", "STCNOFF\n"})
    EXPECT_EQ(
        surface(replaced(replaced(kOff, "OFF\n", header), "1 0 0\n", "1 0 0 255 0 0 255\n"), "a.off").facets,
        facets);
}

TEST(Off, Errors) {
  EXPECT_EQ(error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "a.off"),
            "line 6: a vertex index is out of range: 3 (they run from 0 to 2)");
  EXPECT_EQ(error("OFF\n3 1 0\n0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n", "a.off"),
            "line 4: expected a coordinate, found 'x'");
  EXPECT_EQ(error("OFF\n3 1 0\n0 0 0\n1 0 0\n", "a.off"),
            "line 5: the file ends where a coordinate is expected; it is truncated");
  EXPECT_EQ(error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n", "a.off"),
            "line 7: text after the last of 1 face; the counts are wrong");
  EXPECT_EQ(error("OFF\n4000000000 1 0\n0 0 0\n", "a.off"),
            "line 2: the number of vertices is 4000000000, but only 11 bytes follow; the file is truncated "
            "or damaged");
  EXPECT_EQ(error("4OFF\n1 0 0\n0 0 0 0\n", "a.off"), "line 1: '4OFF' is not OFF of three dimensions");
  EXPECT_EQ(error("OFF BINARY\n1 0 0\n", "a.off"), "byte 15: the file ends too early; it is truncated");
  EXPECT_EQ(error("OFF\n1 0 0\n0 0 1e999\n", "a.off"), "line 3: '1e999' is too large for a double");
  EXPECT_EQ(error("", "a.off"), "the file is empty");
}

TEST(Off, PolygonsAreFannedWhereConvex) {
  const std::string square = "OFF 4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
  EXPECT_EQ(surface(square, "a.off").facets, (Facets{{0, 1, 2}, {0, 2, 3}}));
  // A straight corner at 1: a fan from 0 would be flat.
  const Facets straight =
      surface("OFF 5 1 0\n0 0 0\n1 0 0\n2 0 0\n2 2 0\n0 2 0\n5 0 1 2 3 4\n", "a.off").facets;
  EXPECT_EQ(straight, (Facets{{1, 2, 3}, {1, 3, 4}, {1, 4, 0}}));
  // A pentagram turns left at every corner, and is no fan.
  const Surface pentagram =
      surface("OFF 5 1 0\n0 3 0\n-2 -3 0\n3 1 0\n-3 1 0\n2 -3 0\n5 0 1 2 3 4\n", "a.off");
  EXPECT_EQ(pentagram.facets.size(), 3u);
  EXPECT_NE(pentagram.remarks[0].message.find("the sides of 1 cross"), std::string::npos);
  // Nor is one that winds round its first corner twice, although all triangles with that corner turn left.
  const Surface twice =
      surface("OFF 6 1 0\n0 -1 0\n2 -1 0\n0 3 0\n-4 -2 0\n4 -4 0\n1 1 0\n6 0 1 2 3 4 5\n", "a.off");
  EXPECT_NE(twice.remarks[0].message.find("the sides of 1 cross"), std::string::npos);
}

TEST(Numbers, AreReadAsTheyAre) {
  const Surface s =
      surface("OFF 3 0 0\n+1.5 -0 1e-400\nnan inf -inf\n-1e-999999999999999999999 .5 5.\n", "a.off");
  EXPECT_EQ(bits(s.vertices)[0], bits({{1.5, 0, 0}})[0]);
  EXPECT_EQ(bits(s.vertices)[1], bits({{-0.0, 0, 0}})[0]);
  EXPECT_EQ(bits(s.vertices)[2], bits({{0.0, 0, 0}})[0]);
  EXPECT_TRUE(std::isnan(s.vertices[1][0]));
  EXPECT_EQ(s.vertices[1][1], std::numeric_limits<double>::infinity());
  EXPECT_EQ(bits(s.vertices)[6], bits({{-0.0, 0, 0}})[0]);
  EXPECT_EQ(s.vertices[2][1], 0.5);
  EXPECT_EQ(s.vertices[2][2], 5);
  for (const char* bad :
       {"1.5.2", "0x10", "1,5", "--1", "+-1", "1e", "one", "1e99999999999999999999", "\x01"})
    EXPECT_NE(error("OFF 1 0 0\n" + std::string(bad) + " 0 0\n", "a.off"), "read") << bad;
}

TEST(Stl, AsciiIsWeldedAndSolidsAreMarkers) {
  const Surface s = surface(kStl, "a.stl");
  EXPECT_EQ(s.vertices, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(s.facets, (Facets{{0, 1, 2}, {1, 2, 3}}));
  EXPECT_EQ(s.facet_markers, (std::vector<int>{1, 2}));
  EXPECT_EQ(surface(replaced(kStl, "facet", "FACET"), "a.stl").facets, s.facets);
  const std::string first = std::string(kStl).substr(0, std::string(kStl).find("solid\nfacet"));
  EXPECT_TRUE(surface(first, "a.stl").facet_markers.empty());
}

TEST(Stl, BinaryMayStartWithSolid) {
  const std::vector<std::array<float, 9>> triangles = {{0, 0, 0, 0.1f, 0, 0, 0, 1, 0},
                                                       {0.1f, -0.0f, -0.0f, 0, 0, 1, 0, 1, 0}};
  for (const char* header : {"", "solid facet normal"}) {
    const Surface s = surface(binary_stl(header, triangles), "a.stl");
    EXPECT_EQ(s.facets, (Facets{{0, 1, 2}, {1, 3, 2}}));
    EXPECT_EQ(s.vertices[1], (Point{static_cast<double>(0.1f), 0, 0}));
  }
  EXPECT_EQ(surface(binary_stl("solid", triangles), "a.stl").vertices.size(), 4u);
}

TEST(Stl, BytesBehindTheTrianglesThatAreNoneAreLeftOut) {
  const std::string bytes = binary_stl("solid x", {{0, 0, 0, 1, 0, 0, 0, 1, 0}});
  const Surface s = surface(bytes + "\r\n", "a.stl");
  EXPECT_EQ(s.facets.size(), 1u);
  ASSERT_EQ(s.remarks.size(), 1u);
  EXPECT_EQ(s.remarks[0].message, "2 bytes after the triangles are left out");
  EXPECT_EQ(surface(kStl + std::string(100, '\0'), "a.stl").facets, surface(kStl, "a.stl").facets);
}

TEST(Stl, Errors) {
  const std::vector<std::array<float, 9>> triangles(3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  const std::string bytes = binary_stl("solid x", triangles);
  EXPECT_EQ(
      error(bytes.substr(0, 200), "a.stl"),
      "byte 84: 3 triangles are announced, but only 116 bytes follow; the file is truncated or damaged");
  EXPECT_EQ(error(bytes + std::string(50, 'x'), "a.stl"),
            "byte 84: the header announces 3 triangles, but 50 more bytes follow them");
  EXPECT_EQ(error("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n", "a.stl"),
            "line 6: expected 'vertex', found 'endloop'");
  EXPECT_EQ(error("solid x\n", "a.stl"),
            "line 2: the file ends where 'facet' or 'endsolid' is expected; it is truncated");
  EXPECT_NE(error("not a solid", "a.stl"), "read");
}

TEST(Weld, IdenticalOnly) {
  std::vector<Point> points;
  Welder weld(points);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(weld.add({-0.0, 1, 2}), 0u);
  EXPECT_EQ(weld.add({0.0, 1, 2}), 0u);
  EXPECT_EQ(weld.add({0.0, 1, std::nextafter(2.0, 3.0)}), 1u);
  EXPECT_EQ(weld.add({nan, 1, 2}), 2u);
  EXPECT_EQ(weld.add({nan, 1, 2}), 2u);
  EXPECT_TRUE(std::signbit(points[0][0]));
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(weld.add({1.0 * i, 7, 8}), static_cast<Index>(3 + i));
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(weld.add({1.0 * i, 7, 8}), static_cast<Index>(3 + i));
}

TEST(Obj, ElementsAndRelativeIndices) {
  const Surface s = surface(kObj, "a.obj");
  EXPECT_EQ(s.vertices.size(), 5u);
  EXPECT_EQ(s.facets, (Facets{{0, 1, 2}, {0, 2, 3}, {0, 1, 4}}));
  EXPECT_EQ(s.segments, (Segments{{0, 4}, {4, 1}}));
  // Relative indices count from their line; absolute ones may refer to later lines.
  EXPECT_EQ(surface("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 \\\n -1 # x\nv 1 1 1\n", "a.obj").facets,
            (Facets{{0, 1, 2}, {0, 1, 2}}));
}

TEST(Obj, Errors) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(error(points + "f 1 2 4\n", "a.obj"),
            "line 4: the vertex index 4 is out of range; there are 3 vertices and the first is 1");
  EXPECT_EQ(error(points + "f 0 1 2\n", "a.obj").substr(0, 7), "line 4:");
  EXPECT_EQ(error("f -1 -2 -3\n" + points, "a.obj"),
            "line 1: the vertex index -1 is out of range; there are 0 vertices before it and the first is 1");
  EXPECT_EQ(error(points + "f 1 2 3x\n", "a.obj"), "line 4: expected a vertex index, found '3x'");
  EXPECT_EQ(error(points + "face 1 2 3\n", "a.obj"), "line 4: unknown statement 'face'");
  EXPECT_EQ(error("v 0 0\nv 1 0 0\n", "a.obj"), "line 2: expected a coordinate, found 'v'");
  EXPECT_EQ(error("# nothing\n", "a.obj"), "the file holds no vertices");
}

TEST(Ply, Ascii) {
  for (const std::string& text :
       {std::string(kPly), replaced(kPly, "\n", "\r\n"), replaced(kPly, "\n", "\r")}) {
    const Surface s = surface(text, "a.ply");
    EXPECT_EQ(s.vertices[3], (Point{0, 0, 1}));
    EXPECT_EQ(s.facets, (Facets{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}}));
    EXPECT_EQ(s.segments, (Segments{{2, 3}}));
  }
}

TEST(Ply, Binary) {
  for (const bool big : {false, true}) {
    for (const char* line_end : {"\n", "\r\n", "\r"}) {
      const Surface s = surface(binary_ply(big, line_end), "a.ply");
      ASSERT_EQ(s.vertices.size(), 3u);
      EXPECT_EQ(s.vertices[0], (Point{0.1, static_cast<double>(-0.1f), 1.0}));
      EXPECT_EQ(s.facets, (Facets{{2, 0, 1}}));
      EXPECT_EQ(s.segments, (Segments{{1, 2}}));
    }
  }
}

TEST(Ply, Errors) {
  EXPECT_EQ(error(replaced(kPly, "0 3 1 2 3\n", "0 3 1 2 4\n"), "a.ply"),
            "line 22: the vertex index 4 is out of range; there are 4 vertices and the first is 0");
  EXPECT_EQ(error(replaced(kPly, "vertex_indices", "corners"), "a.ply"),
            "line 9: the element 'face' has no property 'vertex_indices'");
  EXPECT_EQ(error(replaced(kPly, "property float x", "property half x"), "a.ply"),
            "line 5: expected a type such as float or int, found 'half'");
  const std::string bytes = binary_ply(false);
  EXPECT_EQ(error(bytes.substr(0, bytes.size() - 1), "a.ply").substr(0, 5), "byte ");
  EXPECT_NE(error(replaced(bytes, "vertex 3", "vertex 4"), "a.ply"), "read");
}

TEST(Medit, ReadsBoth) {
  const Volume v = volume(kMesh, "a.mesh");
  EXPECT_EQ(v.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}}));
  EXPECT_EQ(v.regions, (std::vector<int>{5}));
  EXPECT_EQ(v.facets, (Facets{{0, 2, 1}, {0, 1, 3}}));
  EXPECT_EQ(v.facet_markers, (std::vector<int>{10, 20}));
  EXPECT_EQ(v.segment_markers, (std::vector<int>{8}));
  EXPECT_EQ(surface(kMesh, "a.mesh").facets, v.facets);
}

TEST(Medit, Errors) {
  EXPECT_EQ(
      error(replaced(kMesh, "Ridges\n1\n1", "HexahedraQ2\n1\n1 2 3 4 1 2 0"), "a.mesh"),
      "line 21: the section 'hexahedraq2' is not read; split its elements into triangles or tetrahedra");
  EXPECT_EQ(error(replaced(kMesh, "Ridges\n1\n1", "Prisms\n0"), "a.mesh"), "read");
  EXPECT_EQ(error(replaced(kMesh, "1 2 4 20", "1 2 5 20"), "a.mesh"),
            "line 17: a vertex index is out of range: 5 (they run from 1 to 4)");
  EXPECT_EQ(error("MeshVersionFormatted 2\nDimension 3\n", "a.mesh"),
            "line 3: the file ends where a keyword or End is expected; it is truncated");
  EXPECT_EQ(error(replaced(kMesh, "\n3\n#", "\n4\n#"), "a.mesh"), "line 3: the dimension is neither 3 nor 2");
}

// SfePy's meshes end this way.
TEST(Medit, WithoutEndIsReadAndTold) {
  const Surface s = surface(replaced(kMesh, "End\n", ""), "a.mesh");
  EXPECT_EQ(s.facets, surface(kMesh, "a.mesh").facets);
  const auto told = [](const Remark& r) { return r.message.starts_with("the file ends without 'End'"); };
  EXPECT_EQ(std::count_if(s.remarks.begin(), s.remarks.end(), told), 1);
}

TEST(Medit, OfTwoDimensionsLiesInThePlane) {
  const Surface s = surface(
      "MeshVersionFormatted 1\nDimension 2\nVertices\n3\n0 0 1\n2 0 1\n0.5 3 1\n"
      "Triangles\n1\n1 2 3 7\nEnd\n",
      "a.mesh");
  EXPECT_EQ(s.vertices, (std::vector<Point>{{0, 0, 0}, {2, 0, 0}, {0.5, 3, 0}}));
  EXPECT_EQ(s.facets, (Facets{{0, 1, 2}}));
}

TEST(Gmf, EveryVersionAndByteOrder) {
  for (const std::int32_t version : {1, 2, 3, 4}) {
    for (const bool big : {false, true}) {
      const Volume v = volume(binary_gmf(version, big), "a.meshb");
      EXPECT_EQ(v.vertices, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
      EXPECT_EQ(v.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}}));
      EXPECT_EQ(v.regions, (std::vector<int>{10}));
      EXPECT_EQ(v.facet_markers, (std::vector<int>{-20}));
      EXPECT_EQ(v.segment_markers, (std::vector<int>{30}));
    }
  }
}

TEST(Poly, FacetsHolesAndRegions) {
  const Surface s = surface(kPoly, "a.poly");
  EXPECT_EQ(s.facets, (Facets{{0, 1, 2}, {0, 2, 3}, {0, 1, 4}, {1, 2, 4}}));
  EXPECT_EQ(s.facet_markers, (std::vector<int>{7, 7, 8, 8}));
  EXPECT_EQ(s.segments, (Segments{{0, 4}}));
  EXPECT_EQ(s.holes, (std::vector<Point>{{0.5, 0.5, 0.25}}));
  ASSERT_EQ(s.regions.size(), 2u);
  EXPECT_EQ(s.regions[0].id, 3);
  EXPECT_EQ(s.regions[1].id, -4);
  EXPECT_EQ(s.regions[1].where, (Point{0.2, 0.2, 0.2}));
}

TEST(Poly, SmeshAndNodesBeside) {
  const Surface s = surface(kSmesh, "a.smesh");
  EXPECT_EQ(s.facets, (Facets{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}));
  EXPECT_EQ(s.facet_markers, (std::vector<int>{5, 6, 7, 8}));
  const TemporaryFolder folder;
  put(folder / "b.smesh", "0 3 0 0\n1 0\n3 1 2 3\n");
  try {
    static_cast<void>(read_surface(folder / "b.smesh"));
    FAIL();
  } catch (const FileError& failure) {
    EXPECT_EQ(failure.path(), folder / "b.node");
  }
  put(folder / "b.node", "3 3 1 0\n1 0 0 0 7.5\n2 1 0 0 7.5\n3 0 1 0 7.5\n");
  EXPECT_EQ(read_surface(folder / "b.smesh").facets, (Facets{{0, 1, 2}}));
  EXPECT_EQ(read_surface(folder / "b.node").vertices.size(), 3u);
}

// A square of 4 x 4 with a square hole, a segment and a point inside, in the plane x = 1; then an L.
TEST(Poly, FacetsOfAnyOutlineAreTriangulated) {
  const TemporaryFolder folder;
  put(folder / "a.poly",
      "17 3 0 0\n1 1 0 0\n2 1 4 0\n3 1 4 4\n4 1 0 4\n5 1 1 1\n6 1 2 1\n7 1 2 2\n8 1 1 2\n9 1 3 1\n10 1 3 3\n"
      "11 1 1 3\n12 0 0 0\n13 0 2 0\n14 0 2 1\n15 0 1 1\n16 0 1 2\n17 0 0 2\n"
      "2 1\n4 1 7\n4 1 2 3 4\n4 5 6 7 8\n2 9 10\n1 11\n1 1 1.5 1.5\n1 0 8\n6 12 13 14 15 16 17\n0\n0\n");
  const Surface surface = read_surface(folder / "a.poly");
  const auto area = [&](int marker) {
    double sum = 0;
    for (std::size_t f = 0; f < surface.facets.size(); ++f) {
      const Point &a = surface.vertices[surface.facets[f][0]], &b = surface.vertices[surface.facets[f][1]],
                  &c = surface.vertices[surface.facets[f][2]];
      const double twice = (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]);
      EXPECT_GT(twice, 0) << "turned as the outline";
      if (surface.facet_markers[f] == marker) sum += twice / 2;
    }
    return sum;
  };
  EXPECT_EQ(area(7), 15);
  EXPECT_EQ(area(8), 3);
  EXPECT_EQ(surface.segments, (std::vector<Segment>{{8, 9}}));
  std::size_t at_point = 0;
  for (const Triangle& t : surface.facets) at_point += std::count(t.begin(), t.end(), 10u) > 0 ? 1 : 0;
  EXPECT_GE(at_point, 3u) << "the point is a corner";
}

TEST(Poly, OutlinesThatCrossAreReported) {
  const Surface crossed = surface(replaced(kPoly, "4 1 2 3 4", "4 1 3 2 4"), "a.poly");
  EXPECT_NE(crossed.remarks[0].message.find("the sides of 1 cross"), std::string::npos);
}

TEST(Poly, Errors) {
  EXPECT_EQ(error(replaced(kPoly, "1 0 7", "1 -1 7"), "a.poly"), "line 10: a negative number of holes");
  EXPECT_EQ(error(replaced(kPoly, "3 1 2 5", "3 1 2 6"), "a.poly"),
            "line 13: a vertex index is out of range: 6 (they run from 1 to 5)");
  EXPECT_EQ(error(replaced(kPoly, "0.1 3 -1", "0.1 3.5 -1"), "a.poly"),
            "line 22: a region's attribute must be a whole number of 32 bits");
  EXPECT_EQ(error(replaced(kPoly, "3 1 1 0 1", "4 1 1 0 1"), "a.poly"),
            "line 5: expected vertex 3, found the number 4");
}

TEST(Tetgen, OneBasedAndMissingFiles) {
  const TemporaryFolder folder;
  put(folder / "a.node", "# x\n4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n");
  EXPECT_THROW(static_cast<void>(read_volume(folder / "a.node")), FileError);
  put(folder / "a.ele", "1 4 0\n1 1 2 3 4\n");
  const Volume v = read_volume(folder / "a.ele");
  EXPECT_EQ(v.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}}));
  EXPECT_EQ(v.regions, (std::vector<int>{0}));
  EXPECT_TRUE(v.facets.empty());
  put(folder / "a.face", "1 1\n1 1 2 3 -1\n");
  EXPECT_EQ(read_volume(folder / "a.node").facet_markers, (std::vector<int>{-1}));
  put(folder / "a.ele", "1 10 0\n1 1 2 3 4 1 2 3 4 1 2\n");
  EXPECT_THROW(static_cast<void>(read_volume(folder / "a.node")), FileError);
}

TEST(Msh, Version2) {
  const Volume v = volume(kMsh2, "a.msh");
  EXPECT_EQ(v.vertices, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(v.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}}));
  EXPECT_EQ(v.facets, (Facets{{0, 2, 1}}));
  EXPECT_EQ(v.regions, (std::vector<int>{9}));
  EXPECT_EQ(v.facet_markers, (std::vector<int>{7}));
  EXPECT_EQ(v.segment_markers, (std::vector<int>{3}));  // no physical tag: the elementary one
}

TEST(Msh, Version4) {
  const Volume v = volume(kMsh4, "a.msh");
  EXPECT_EQ(v.vertices, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(v.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}}));
  EXPECT_EQ(v.regions, (std::vector<int>{4}));
  EXPECT_EQ(v.facet_markers, (std::vector<int>{7}));
  EXPECT_EQ(v.segment_markers, (std::vector<int>{1}));  // its physical tags: none
}

TEST(Msh, Errors) {
  EXPECT_EQ(error(replaced(kMsh2, "2.2 0 8", "2.2 1 8"), "a.msh"),
            "line 2: the number 1, which shows the byte order, is missing");
  EXPECT_EQ(error(replaced(kMsh2, "2.2 0 8", "5 0 8"), "a.msh"),
            "line 2: version '5' is not read; save it as 4.1 or 2.2");
  EXPECT_EQ(error(replaced(kMsh2, "1 10 30 20", "1 10 30 25"), "a.msh"),
            "line 19: the node 25 does not exist");
  EXPECT_EQ(error(replaced(kMsh2, "20 1 0 0", "10 1 0 0"), "a.msh").substr(9),
            "the node tag 10 occurs twice");
  EXPECT_EQ(error(replaced(kMsh2, "4 4 2 9", "4 32 2 9"), "a.msh").substr(9, 29),
            "elements of type 32 are not r");
}

TEST(Vtk, AsciiAndBinary) {
  for (const Volume& v : {volume(kVtk, "a.vtk"), volume(binary_vtk(), "a.vtk")}) {
    EXPECT_EQ(v.vertices, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
    EXPECT_EQ(v.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}}));
    EXPECT_EQ(v.facets, (Facets{{0, 2, 1}}));
    EXPECT_EQ(v.regions, (std::vector<int>{6}));
    EXPECT_EQ(v.facet_markers, (std::vector<int>{7}));
  }
  EXPECT_EQ(volume(kVtk, "a.vtk").segment_markers, (std::vector<int>{8}));
}

TEST(Vtk, Polydata) {
  const Surface s = surface(
      "# vtk DataFile Version 2.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\n"
      "LINES 1 4\n3 0 1 2\nPOLYGONS 2 9\n4 0 1 2 3\n3 0 1 2\nCELL_DATA 3\nSCALARS marker int\n1 2 3\n",
      "a.vtk");
  EXPECT_EQ(s.facets, (Facets{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}}));
  EXPECT_EQ(s.facet_markers, (std::vector<int>{2, 2, 3}));
  EXPECT_EQ(s.segments, (Segments{{0, 1}, {1, 2}}));
  EXPECT_EQ(s.segment_markers, (std::vector<int>{1, 1}));
}

TEST(Vtu, Ascii) {
  const Volume v = volume(kVtu, "a.vtu");
  EXPECT_EQ(v.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}}));
  EXPECT_EQ(v.facets, (Facets{{0, 2, 1}}));
  EXPECT_EQ(v.segments, (Segments{{0, 1}}));
  EXPECT_EQ(v.regions, (std::vector<int>{6}));
  EXPECT_EQ(v.facet_markers, (std::vector<int>{7}));
  EXPECT_EQ(v.segment_markers, (std::vector<int>{8}));
}

TEST(Vtu, Base64) {
  // 4 bytes of size and 12 of data, encoded together; and with the size encoded separately.
  for (const char* offsets : {"DAAAAAQAAAAHAAAACQAAAA==", "DAAAAA==BAAAAAcAAAAJAAAA"}) {
    const std::string text = replaced(kVtu, "Name=\"offsets\" format=\"ascii\">4 7 9",
                                      std::string("Name=\"offsets\" format=\"binary\">\n ") + offsets + "\n");
    EXPECT_EQ(volume(text, "a.vtu").segments, (Segments{{0, 1}})) << offsets;
  }
}

TEST(Vtu, Errors) {
  EXPECT_EQ(error(replaced(kVtu, "0 2 1 0 1<", "0 2 1 0 4<"), "a.vtu"),
            "cell 2: names vertex 4, but there are 4");
  EXPECT_EQ(error(replaced(kVtu, ">10 5 3<", ">10 42 3<"), "a.vtu").substr(0, 20), "cell 1: is of type 4");
  EXPECT_EQ(error(replaced(kVtu, "NumberOfPoints='4'", "NumberOfPoints='5'"), "a.vtu"),
            "line 8: the array has 12 values instead of 15");
  EXPECT_EQ(
      error(replaced(kVtu, "byte_order", "compressor=\"vtkBrotliDataCompressor\" byte_order"), "a.vtu"),
      "line 3: data compressed by 'vtkBrotliDataCompressor' is not read; save it with zlib, LZ4 or LZMA, "
      "or without");
  const std::string text = kVtu;
  EXPECT_EQ(error(text.substr(0, text.size() - 11), "a.vtu"),
            "the file does not end with </VTKFile>; it is truncated");
  EXPECT_EQ(error("<html></html>", "a.vtu"), "not a VTK XML file: it has no VTKFile element");
}

TEST(Files, PathsThatAreNoFiles) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "folder.off");
  const auto reason = [&](const std::string& name, std::string_view format = {}) -> std::string {
    try {
      static_cast<void>(read_surface(folder / name, format));
    } catch (const FileError& failure) {
      return failure.what();
    }
    return "read";
  };
  EXPECT_NE(reason("none.off").find("no such file"), std::string::npos);
  EXPECT_NE(reason("folder.off").find("is a directory"), std::string::npos);
  put(folder / "a.xyz", kOff);
  EXPECT_NE(reason("a.xyz").find("the format '.xyz' cannot be read as a surface; the formats are .off, .stl"),
            std::string::npos);
  for (const char* of_cad : {"a.step", "a.STP", "a.iges", "a.brep"})
    EXPECT_NE(reason(of_cad).find("without triangles: export it as STL, or `gmsh -2 IN"), std::string::npos)
        << of_cad;
  EXPECT_NE(reason("a.fbx").find(
                "cannot be read as a surface; Blender, MeshLab or assimp save it as .obj; the formats are"),
            std::string::npos);
  EXPECT_NE(reason("a.vtkhdf").find("; ParaView saves it as .vtu; the formats are"), std::string::npos);
  EXPECT_NE(reason("a.ugrid").find("; `meshio convert IN OUT.vtu` reads it; the formats are"),
            std::string::npos);
  EXPECT_NE(reason("a.foam").find("; give the case's folder; the formats are"), std::string::npos);
  EXPECT_EQ(reason("a.xyz", ".off"), "read");
  EXPECT_EQ(reason("a.xyz", "OFF"), "read");
  EXPECT_THROW(static_cast<void>(read_volume(folder / "a.xyz", ".off")), FileError);
  std::filesystem::create_symlink("/dev/zero", folder / "zero.off");
  EXPECT_NE(reason("zero.off").find("is a device"), std::string::npos);
}

}  // namespace
}  // namespace holdfast::io_readers_test
