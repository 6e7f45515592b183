// Variants of formats that many programs write: binary OFF and .msh, strips, quadrangles, compressed files,
// sections without data; and numbers that make no sense in any file.
#include <gtest/gtest.h>
#include <zlib.h>

#include <chrono>

#include "gltf_samples.h"
#include "io_samples.h"

namespace holdfast::io_variants_test {
namespace {

using namespace samples;
using Facets = std::vector<Triangle>;
using Segments = std::vector<Segment>;

class Variants : public ::testing::Test {
 protected:
  Surface surface(const std::string& bytes, const std::string& name) {
    put(folder_ / name, bytes);
    return read_surface(folder_ / name);
  }
  Volume volume(const std::string& bytes, const std::string& name) {
    put(folder_ / name, bytes);
    return read_volume(folder_ / name);
  }
  /// The error that reading gives, without the path.
  std::string error(const std::string& bytes, const std::string& name) {
    put(folder_ / name, bytes);
    try {
      static_cast<void>(read_surface(folder_ / name));
    } catch (const FileError& failure) {
      return std::string(failure.what()).substr(failure.path().string().size() + 2);
    }
    return "read";
  }
  TemporaryFolder folder_;
};

std::string gzip(const std::string& bytes) {
  std::string packed(compressBound(bytes.size()) + 64, '\0');
  z_stream stream{};
  constexpr int kGzip = 16;
  EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, MAX_WBITS + kGzip, 9, Z_DEFAULT_STRATEGY), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

TEST_F(Variants, ExponentsOfFortran) {
  const std::string head = "MeshVersionFormatted 1\nDimension 3\nVertices 3\n0.0D+00 0 0 0\n",
                    tail = " 0 0\n0 1d+1 0 0\nTriangles 1\n1 2 3 0\nEnd\n";
  const Surface s = surface(head + "-1.5D-01 0" + tail, "a.mesh");
  EXPECT_EQ(s.vertices, (std::vector<Point>{{0, 0, 0}, {-0.15, 0, 0}, {0, 10, 0}}));
  EXPECT_EQ(error(head + "1.5D+999 0" + tail, "a.mesh"), "line 5: '1.5D+999' is too large for a double");
  EXPECT_EQ(error(head + "1.5D 0" + tail, "a.mesh"), "line 5: expected a coordinate, found '1.5D'");
}

TEST_F(Variants, BinaryOff) {
  for (const bool normals : {false, true}) {
    const Surface s = surface(binary_off(normals), "a.off");
    ASSERT_EQ(s.vertices.size(), 5u);
    EXPECT_EQ(s.vertices[4], (Point{0, static_cast<double>(0.1f), 1}));
    EXPECT_EQ(s.facets, (Facets{{0, 1, 4}, {0, 3, 2}, {0, 2, 1}}));
    EXPECT_EQ(s.segments, (Segments{{3, 4}}));
  }
  const std::string bytes = binary_off(false);
  EXPECT_NE(error(bytes + '\0', "a.off").find("bytes after the last of 3 faces"), std::string::npos);
  std::string wrong = bytes;
  wrong.replace(bytes.size() - 8, 4, raw(std::int32_t{5}, true));
  EXPECT_NE(error(wrong, "a.off").find("the vertex index 5 is out of range"), std::string::npos);
}

TEST_F(Variants, BinaryMshInBothVersionsAndByteOrders) {
  for (const bool big : {false, true})
    for (const auto& [modern, size] : {std::pair(false, 8u), std::pair(true, 8u), std::pair(true, 4u)}) {
      const Volume v = volume(binary_msh(modern, big, size), "a.msh");
      EXPECT_EQ(v.vertices, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}}));
      EXPECT_EQ(v.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}}));
      EXPECT_EQ(v.regions, (std::vector<int>{9}));
      EXPECT_EQ(v.facets, (Facets{{0, 2, 1}, {0, 1, 4}, {0, 4, 2}}));
      EXPECT_EQ(v.facet_markers, (std::vector<int>{7, 8, 8}));
      EXPECT_EQ(v.segments, (Segments{{0, 1}}));
      EXPECT_EQ(v.segment_markers, (std::vector<int>{3}));
      EXPECT_EQ(v.vertex_markers, (std::vector<int>{0, 6, 0, 0, 0}));
    }
  EXPECT_NE(error(binary_msh(true, false).substr(0, 300), "a.msh").find("truncated"), std::string::npos);
}

/// Version 4.0 as text or as bytes: tags of entities precede their dimensions, and each node follows its tag.
std::string msh_4_0(bool binary) {
  const auto i = [&](std::int32_t value) {
    return binary ? raw(value, false) : std::to_string(value) + "\n";
  };
  const auto n = [&](std::uint64_t value) {
    return binary ? raw(value, false) : std::to_string(value) + "\n";
  };
  const auto point = [&](double x, double y, double z) {
    return binary ? raw(x, false) + raw(y, false) + raw(z, false)
                  : std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
  };
  const std::string box = point(0, 0, 0) + point(1, 1, 1);
  std::string text = std::string("$MeshFormat\n4 ") +
                     (binary ? "1 8\n" + raw(std::int32_t{1}, false) + "\n" : "0 8\n") +
                     "$EndMeshFormat\n$Entities\n";
  text += n(1) + n(1) + n(1) + n(1) + i(1) + box + n(1) + i(6);
  text +=
      i(5) + box + n(0) + n(1) + i(-1) + i(6) + box + n(1) + i(7) + n(0) + i(8) + box + n(0) + n(1) + i(6);
  text += "\n$EndEntities\n$Nodes\n" + n(2) + n(4);
  text += i(8) + i(3) + i(0) + n(1) + i(40) + point(0, 0, 1);
  text += i(6) + i(2) + i(1) + n(3);  // parametric: two more numbers behind each
  const std::string parameters =
      point(0.1, 0.2, 0).substr(0, binary ? 16 : std::string("0.100000 0.200000").size()) +
      (binary ? "" : "\n");
  text += i(10) + point(0, 0, 0) + parameters + i(20) + point(1, 0, 0) + parameters + i(30) + point(0, 1, 0) +
          parameters;
  text += "\n$EndNodes\n$Elements\n" + n(4) + n(4);
  text += i(1) + i(0) + i(15) + n(1) + i(1) + i(20);
  text += i(5) + i(1) + i(1) + n(1) + i(2) + i(10) + i(20);
  text += i(6) + i(2) + i(2) + n(1) + i(3) + i(10) + i(30) + i(20);
  text += i(8) + i(3) + i(4) + n(1) + i(4) + i(10) + i(20) + i(30) + i(40);
  return text + "\n$EndElements\n";
}

/// Entities are text even if numbers are bytes. The second node has parameters on a curve, the third on a
/// surface; the tetrahedron is in a part.
std::string msh_3(bool binary) {
  const auto i = [&](std::int32_t v) { return binary ? raw(v, false) : std::to_string(v) + " "; };
  const auto x = [&](double v) { return binary ? raw(v, false) : std::to_string(v) + " "; };
  std::string text = "$MeshFormat\n3 " + std::string(binary ? "1 8\n" + raw(std::int32_t{1}, false) : "0 8") +
                     "\n$EndMeshFormat\n";
  text += "$Entities\n1 1 1 1\n1 1 6 \n1 2 1 1 1 5 \n2 1 1 1 7 \n4 1 2 1 8 \n$EndEntities\n$Nodes\n4\n";
  text += i(10) + x(0) + x(0) + x(0) + i(0);
  text += i(20) + x(1) + x(0) + x(0) + i(1) + i(1) + x(0.5);
  text += i(40) + x(0) + x(0) + x(1) + i(2) + i(2) + x(0.25) + x(0.75);
  text += i(30) + x(0) + x(1) + x(0) + i(1) + i(0);
  text += "\n$EndNodes\n$Elements\n4\n";
  text += i(1) + i(15) + i(1) + i(1) + i(20);
  text += i(2) + i(1) + i(1) + i(2) + i(10) + i(20);
  text += i(3) + i(2) + i(2) + i(3) + i(10) + i(30) + i(20);
  text += i(4) + i(4) + i(4) + i(6) + i(10) + i(20) + i(30) + i(40) + i(1) + i(1);
  return text + "\n$EndElements\n";
}

TEST_F(Variants, OlderVersionsOfMsh) {
  const std::string first =
      "$NOD\n4\n10 0 0 0\n20 1 0 0\n40 0 0 1\n30 0 1 0\n$ENDNOD\n$ELM\n4\n1 15 6 1 1 20\n"
      "2 1 0 5 2 10 20\n3 2 7 6 3 10 30 20\n4 4 0 8 4 10 20 30 40\n$ENDELM\n";
  for (const std::string& bytes : {first, msh_3(false), msh_3(true), msh_4_0(false), msh_4_0(true)}) {
    const Volume v = volume(bytes, "a.msh");
    EXPECT_EQ(v.vertices, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
    EXPECT_EQ(v.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}}));
    EXPECT_EQ(v.regions, (std::vector<int>{8}));
    EXPECT_EQ(v.facets, (Facets{{0, 2, 1}}));
    EXPECT_EQ(v.facet_markers, (std::vector<int>{7}));
    EXPECT_EQ(v.segments, (Segments{{0, 1}}));
    EXPECT_EQ(v.segment_markers, (std::vector<int>{5}));
    EXPECT_EQ(v.vertex_markers, (std::vector<int>{0, 6, 0, 0}));
    const std::string cut = bytes.substr(0, bytes.size() - 30);
    EXPECT_NE(error(cut, "a.msh"), "read");
  }
}

TEST_F(Variants, MeshbOfTwoDimensions) {
  for (const bool big : {false, true}) {
    const auto i = [&](std::int32_t value) { return raw(value, big); };
    const auto xy = [&](double x, double y, std::int32_t reference) {
      return raw(x, big) + raw(y, big) + i(reference);
    };
    std::string bytes = i(1) + i(2) + i(3) + i(20) + i(2);  // version 2, two dimensions
    bytes += i(4) + i(92) + i(3) + xy(0, 0, 0) + xy(2, 0, 6) + xy(0, 2, 0);
    bytes += i(5) + i(116) + i(1) + i(1) + i(2) + i(5);
    bytes += i(6) + i(144) + i(1) + i(1) + i(2) + i(3) + i(7) + i(54) + i(0);
    const Surface s = surface(bytes, "a.meshb");
    EXPECT_EQ(s.vertices, (std::vector<Point>{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}));
    EXPECT_EQ(s.facets, (Facets{{0, 1, 2}}));
    EXPECT_EQ(s.facet_markers, (std::vector<int>{7}));
    EXPECT_EQ(s.segment_markers, (std::vector<int>{5}));
    EXPECT_EQ(s.vertex_markers, (std::vector<int>{0, 6, 0}));
  }
}

TEST_F(Variants, UcdOfAvs) {
  const std::string bytes =
      "# made by hand\n4 4 1 0 0\n10 0 0 0\n20 1 0 0\n40 0 0 1\n30 0 1 0\n1 6 pt 20\n2 5 line 10 20\n"
      "3 7 tri 10 30 20\n4 8 tet 10 20 30 40\n1 1\nt, K\n10 1\n20 2\n40 3\n30 4\n";
  const std::string turned = bytes.substr(0, bytes.find("10 20 30 40")) + "10 30 20 40\n";
  for (const auto& [file, text] :
       {std::pair("a.inp", bytes), std::pair("a.avs", bytes), std::pair("a.ucd", turned)}) {
    const Volume v = volume(text, file);
    EXPECT_EQ(v.vertices, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}}));
    EXPECT_EQ(v.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 3, 2}}));
    EXPECT_EQ(v.regions, (std::vector<int>{8}));
    EXPECT_EQ(v.facets, (Facets{{0, 3, 1}}));
    EXPECT_EQ(v.facet_markers, (std::vector<int>{7}));
    EXPECT_EQ(v.segments, (Segments{{0, 1}}));
    EXPECT_EQ(v.segment_markers, (std::vector<int>{5}));
    EXPECT_EQ(v.vertex_markers, (std::vector<int>{0, 6, 0, 0}));
  }
  EXPECT_EQ(surface(bytes, "a.avs").remarks.size(), 2u);  // values at nodes, and a tetrahedron
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = bytes;
    return error(changed.replace(changed.find(from), from.size(), to), "a.avs");
  };
  EXPECT_EQ(
      with("3 7 tri", "3 7 oct"),
      "line 9: cells of the kind 'oct' are not read; only pt, line, tri, quad, tet, pyr, prism and hex are");
  EXPECT_EQ(with("tri 10 30 20", "tri 10 30 25"), "line 9: the node 25 does not exist");
  EXPECT_EQ(with("4 4 1 0 0", "4 4000000 1 0 0").substr(0, 34), "line 2: the number of cells is 400");
  EXPECT_EQ(with("20 1 0 0", "10 1 0 0"), "the node 10 occurs twice");
}

TEST_F(Variants, StlWithoutEndsolid) {
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  const Surface s = surface("solid\n" + facet, "a.stl");
  EXPECT_EQ(s.facets.size(), 1u);
  ASSERT_EQ(s.remarks.size(), 1u);
  EXPECT_NE(s.remarks[0].message.find("endsolid"), std::string::npos);
  EXPECT_NE(error("solid\n" + facet.substr(0, 60), "a.stl"), "read");
  EXPECT_NE(error("solid\n", "a.stl"), "read");
}

TEST_F(Variants, ElementsOfThirdOrderThatGmshWritesToVtk) {
  const Surface s = surface(
      "# vtk DataFile Version 2.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 10 double\n"
      "0 0 0 3 0 0 0 3 0 1 0 0 2 0 0 2 1 0 1 2 0 0 2 0 0 1 0 1 1 0\nCELLS 2 16\n4 0 1 3 4\n"
      "10 0 1 2 3 4 5 6 7 8 9\nCELL_TYPES 2\n3 5\n",
      "a.vtk");
  EXPECT_EQ(s.facets, (Facets{{0, 1, 2}}));
  EXPECT_EQ(s.segments, (Segments{{0, 1}}));
}

TEST_F(Variants, QuadranglesAreCutInEveryFormat) {
  const std::string points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  const Facets cut{{0, 1, 2}, {0, 2, 3}};
  const std::string numbered = "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n";
  EXPECT_EQ(surface("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n" + numbered +
                        "$EndNodes\n$Elements\n1\n1 3 2 5 1 1 2 3 4\n$EndElements\n",
                    "a.msh")
                .facets,
            cut);
  EXPECT_EQ(surface("MeshVersionFormatted 2 Dimension 3 Vertices 4\n0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n"
                    "Quadrilaterals 1\n1 2 3 4 5\nEnd\n",
                    "a.mesh")
                .facet_markers,
            (std::vector<int>{5, 5}));
  BinaryGmf gmf(2, false);
  gmf.section(4, gmf.integer(4) + gmf.real(0) + gmf.real(0) + gmf.real(0) + gmf.integer(0) + gmf.real(1) +
                     gmf.real(0) + gmf.real(0) + gmf.integer(0) + gmf.real(1) + gmf.real(1) + gmf.real(0) +
                     gmf.integer(0) + gmf.real(0) + gmf.real(1) + gmf.real(0) + gmf.integer(0));
  gmf.section(
      7, gmf.integer(1) + gmf.integer(1) + gmf.integer(2) + gmf.integer(3) + gmf.integer(4) + gmf.integer(5));
  EXPECT_EQ(surface(gmf.ended(), "a.meshb").facets, cut);
  EXPECT_EQ(surface("# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n"
                    "0 0 0 1 0 0 0 1 0 1 1 0\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n8\n",
                    "a.vtk")
                .facets,
            (Facets{{0, 1, 3}, {0, 3, 2}}));
}

TEST_F(Variants, AQuadrangleWithARepeatedCornerIsATriangle) {
  const std::string points = "OFF 5 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 1 -0\n";
  EXPECT_EQ(surface(points + "4 0 1 2 2\n", "a.off").facets, (Facets{{0, 1, 2}}));
  EXPECT_EQ(surface(points + "4 0 1 2 0\n", "a.off").facets, (Facets{{1, 2, 0}}));
  EXPECT_EQ(surface(points + "5 0 1 1 2 3\n", "a.off").facets, (Facets{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(surface(points + "4 0 1 3 4\n", "a.off").facets, (Facets{{0, 1, 3}}));  // at one place
  // Two places make no triangle; `diagnose` reports that.
  EXPECT_EQ(surface(points + "4 0 0 1 1\n", "a.off").facets, (Facets{{0, 0, 1}}));
}

TEST_F(Variants, TriangleStrips) {
  const Surface s = surface(kStrips, "a.vtk");
  EXPECT_EQ(s.facets, (Facets{{0, 2, 1}, {0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}}));
  EXPECT_EQ(s.facet_markers, (std::vector<int>{1, 2, 2, 2, 2}));
  EXPECT_EQ(s.vertex_markers, (std::vector<int>{0, 0, 0, 0, 0, 3}));
  const Surface p = surface(
      "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"4\" NumberOfVerts=\"0\" "
      "NumberOfLines=\"0\" "
      "NumberOfStrips=\"1\" NumberOfPolys=\"1\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" "
      "format=\"ascii\">0 0 0 1 0 0 0 1 0 1 1 0</DataArray></Points><Strips><DataArray type=\"Int32\" "
      "Name=\"connectivity\" format=\"ascii\">0 1 2 2 3</DataArray><DataArray type=\"Int32\" "
      "Name=\"offsets\" "
      "format=\"ascii\">5</DataArray></Strips><Polys><DataArray type=\"Int32\" Name=\"connectivity\" "
      "format=\"ascii\">0 2 1</DataArray><DataArray type=\"Int32\" Name=\"offsets\" "
      "format=\"ascii\">3</DataArray>"
      "</Polys><CellData><DataArray type=\"Int32\" Name=\"marker\" format=\"ascii\">5 "
      "6</DataArray></CellData>"
      "</Piece></PolyData></VTKFile>",
      "a.vtp");
  EXPECT_EQ(p.facets, (Facets{{0, 2, 1}, {0, 1, 2}}));
  EXPECT_EQ(p.facet_markers, (std::vector<int>{5, 6}));
}

TEST_F(Variants, LegacyVtkSectionsWithoutArrays) {
  for (const std::string tail : {"\nCELL_DATA 2\nPOINT_DATA 4\n", "\nPOINT_DATA 4", "\nCELL_DATA 2"}) {
    const std::string whole = binary_vtk();
    const std::string bytes = whole.substr(0, whole.find("\nCELL_DATA")) + tail;
    EXPECT_EQ(surface(bytes, "a.vtk").facets, (Facets{{0, 2, 1}})) << tail;
    const std::string text = std::string(kVtk).substr(0, std::string(kVtk).find("CELL_DATA"));
    EXPECT_EQ(surface(text + tail, "a.vtk").facets, (Facets{{0, 2, 1}})) << tail;
  }
}

// Geomview's files may begin with display settings.
TEST_F(Variants, OffWithAnAppearance) {
  const Facets facets = surface(kOff, "a.off").facets;
  for (const char* before :
       {"appearance {\n  +edge # }\n  material { kd 0.5 }\n}\n", "appearance{linewidth 2} "})
    EXPECT_EQ(surface(before + std::string(kOff), "a.off").facets, facets) << before;
  EXPECT_EQ(error("appearance {\n material {\n}\nOFF\n3 1 0\n", "a.off"),
            "line 1: the appearance has no closing brace");
  EXPECT_EQ(error("appearance off\n", "a.off"), "line 1: expected an opening brace, found 'off'");
}

// Blender 2.47 writes such a line.
TEST_F(Variants, PlyWithLinesOfOtherWordsBeforeTheFirstElement) {
  const std::string made =
      "format ascii 1.0\nCreated by Blender3D 2.47 - www.blender.org, source file: a.blend\n";
  const Surface s = surface(replaced(kPly, "format ascii 1.0\n", made), "a.ply");
  EXPECT_EQ(s.facets, surface(kPly, "a.ply").facets);
  ASSERT_FALSE(s.remarks.empty());
  EXPECT_EQ(s.remarks[0].message, "1 line of the header that PLY does not have ('Created') is left out");
  EXPECT_EQ(error(replaced(kPly, "element face", "elemnt face"), "a.ply"),
            "line 9: unknown keyword 'elemnt' in the header");
}

TEST_F(Variants, TriangleStripsInPly) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n9 0 1 2 3 -1 0 2 4 -1\n";
  EXPECT_EQ(surface(text, "a.ply").facets, (Facets{{0, 1, 2}, {2, 1, 3}, {0, 2, 4}}));
  EXPECT_TRUE(surface(text, "a.ply").remarks.empty());
  EXPECT_EQ(error(replaced(text, "2 4 -1", "2 5 -1"), "a.ply"),
            "line 15: the vertex index 5 is out of range; there are 5 vertices and the first is 0");
}

TEST_F(Variants, PackedFiles) {
  put(folder_ / "plain.off", kOff);
  const Surface plain = read_surface(folder_ / "plain.off");
  for (const auto& [name, bytes] :
       {std::pair<std::string, std::string>{"a.off.gz", kOff}, {"a.OFF.GZ", kOff}, {"a.off", kOff}}) {
    EXPECT_EQ(surface(gzip(bytes), name).facets, plain.facets) << name;
  }
  const std::string text = kOff;  // two members, as `cat a.gz b.gz` makes them, and padding
  EXPECT_EQ(
      surface(gzip(text.substr(0, 30)) + gzip(text.substr(30)) + std::string(512, '\0'), "a.off.gz").facets,
      plain.facets);
  EXPECT_EQ(surface(gzip(binary_stl("", {{0, 0, 0, 1, 0, 0, 0, 1, 0}})), "a.stl.gz").facets.size(), 1u);
  EXPECT_EQ(surface(gzip(kObj), "a.obj.gz").facets.size(), 3u);
  EXPECT_EQ(volume(gzip(kVtu), "a.vtu.gz").tetrahedra.size(), 1u);
  put(folder_ / "b.node.gz", gzip("4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n"));
  put(folder_ / "b.ele.gz", gzip("1 4 0\n0 0 1 2 3\n"));
  put(folder_ / "b.mtr.gz", gzip("4 1\n1\n2\n3\n4\n"));
  EXPECT_EQ(read_volume(folder_ / "b.node.gz").tetrahedra.size(), 1u);
  EXPECT_EQ(read_size_field(folder_ / "b.mtr.gz").tetrahedra.size(), 1u);
  put(folder_ / "c.GLTF.gz", gzip(gltf_json("sub/a.bin")));
  EXPECT_EQ(files_of_surface(folder_ / "c.GLTF.gz"),
            (std::vector{folder_ / "c.GLTF.gz", folder_ / "sub/a.bin"}));
}

TEST_F(Variants, WhatStandsBehindAPackedFileIsTold) {
  const std::string said = "12 bytes after the compressed data are left out";
  const Surface s = surface(gzip(kOff) + "and not more", "a.off.gz");
  ASSERT_FALSE(s.remarks.empty());
  EXPECT_EQ(s.remarks.back().message, said);
  EXPECT_EQ(s.remarks.back().count, 12u);
  // Zeros pad tapes.
  const Surface padded = surface(gzip(kOff) + std::string(512, '\0'), "a.off.gz");
  EXPECT_EQ(padded.remarks.size() + 1, s.remarks.size());
  put(folder_ / "a.vtu.gz", gzip(kVtu) + "and not more");
  std::vector<Remark> remarks;
  static_cast<void>(read_volume(folder_ / "a.vtu.gz", {}, &remarks));
  ASSERT_FALSE(remarks.empty());
  EXPECT_EQ(remarks.back().message, said);
}

TEST_F(Variants, DamagedPackedFiles) {
  const std::string packed = gzip(kOff);
  for (std::size_t size = 3; size < packed.size(); ++size)
    EXPECT_NE(error(packed.substr(0, size), "a.off.gz"), "read") << size;
  std::string wrong = packed;
  wrong[packed.size() / 2] = static_cast<char>(wrong[packed.size() / 2] ^ 0x55);
  EXPECT_NE(error(wrong, "a.off.gz"), "read");
  // 400 MB of blanks in 400 kB.
  const std::string bomb = gzip(std::string(std::size_t{400} << 20, ' '));
  EXPECT_NE(error(bomb, "a.off.gz").find("200 times its size"), std::string::npos);
}

TEST_F(Variants, AnArrayOfTooManyValuesIsNotUnpacked) {
  // One block repeated: 3 GiB of zeros that would take seconds to unpack.
  const std::uint64_t block = std::uint64_t{1} << 20, blocks = 3072;
  std::string packed(compressBound(block), '\0');
  uLongf size = packed.size();
  const std::string zeros(block, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(zeros.data()),
           block);
  packed.resize(size);
  std::string data = raw(blocks) + raw(block) + raw(std::uint64_t{0});
  for (std::uint64_t i = 0; i < blocks; ++i) data += raw(std::uint64_t{size});
  for (std::uint64_t i = 0; i < blocks; ++i) data += packed;
  const std::string file =
      "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
      "compressor=\"vtkZLibDataCompressor\">\n<PolyData><Piece NumberOfPoints=\"6\" NumberOfPolys=\"1\">\n"
      "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"appended\" "
      "offset=\"0\"/></Points>\n"
      "</Piece></PolyData><AppendedData encoding=\"raw\">_" +
      data;
  EXPECT_EQ(error(file, "a.vtp"), "line 3: the array has 402653184 values instead of 18");
}

TEST_F(Variants, NumbersBeyond64Bits) {
  const std::string huge = "99999999999999999999", most = "9223372036854775807",
                    least = "-9223372036854775808";
  for (const std::string& index : {huge, most, least}) {
    EXPECT_EQ(error("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 " + index + "\n", "a.off").substr(0, 7),
              "line 5:");
    EXPECT_EQ(error("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 " + index + "\n", "a.obj").substr(0, 7), "line 4:");
    EXPECT_EQ(error("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n2\n" + least +
                        " 0 0 0\n1 1 0 0\n$EndNodes\n"
                        "$Elements\n1\n1 2 0 1 " +
                        index + " 2\n$EndElements\n",
                    "a.msh")
                  .substr(0, 8),
              "line 11:");
    put(folder_ / "a.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n");
    put(folder_ / "a.ele", "2 4 0\n" + index + " 0 1 2 3\n1 0 1 2 3\n");
    EXPECT_THROW(static_cast<void>(read_volume(folder_ / "a.node")), FileError);
  }
  EXPECT_EQ(error("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 " + huge + "\n", "a.off"),
            "line 5: a vertex index is beyond 64 bits: '99999999999999999999'");
}

}  // namespace
}  // namespace holdfast::io_variants_test
