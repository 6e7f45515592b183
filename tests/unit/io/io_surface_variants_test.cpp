// Peculiarities of surface files from other programs: unknown counts, dimensions, colours, an order of
// elements, arrays of strings.
#include <gtest/gtest.h>

#include <algorithm>

#include "io/byte_reader.h"
#include "io_samples.h"

namespace holdfast::io_surface_variants_test {
namespace {

using namespace samples;

class SurfaceVariants : public ::testing::Test {
 protected:
  Surface surface(const std::string& bytes, const std::string& name) {
    put(folder_ / name, bytes);
    return read_surface(folder_ / name);
  }
  std::string error(const std::string& bytes, const std::string& name) {
    return refusal_of([&] { return surface(bytes, name); });
  }
  TemporaryFolder folder_;
};

TEST_F(SurfaceVariants, NumbersOfOffOnAnyLines) {
  const std::string tetrahedron = "0 0 0 1 0 0 0 1 0 0 0 1", faces = "3 0 2 1 3 0 1 3 3 1 2 3 3 2 0 3";
  const Surface whole = surface("OFF 4 4 6 " + tetrahedron + " " + faces, "a.off");
  EXPECT_EQ(whole.vertices.size(), 4u);
  EXPECT_EQ(whole.facets, (std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}));
  EXPECT_EQ(surface("OFF\n4 4 0\n" + tetrahedron + "\n" + faces + "\n", "a.off").facets, whole.facets);
  EXPECT_EQ(surface("OFF\n4 4\n" + tetrahedron + "\n3 0 2 1\n3 0 1 3 3 1 2 3\n3 2 0 3", "a.off").facets,
            whole.facets);
  const Surface normals =
      surface("NOFF 3 1 0 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1 3 0 1 2", "a.off");  // of three vertices
  EXPECT_EQ(normals.vertices[2], (Point{0, 1, 0}));
  EXPECT_EQ(normals.remarks.size(), 1u);
  // Where neither fits, the message is that of lines.
  EXPECT_EQ(error("OFF 4 4 6 " + tetrahedron + " " + faces + " 0", "a.off"),
            error("OFF 4 4 6 " + tetrahedron + " " + faces + " 0 1", "a.off"));
  EXPECT_EQ(error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 5\n", "a.off").substr(0, 7), "line 6:");
}

/// ASCII text in UTF-16 with its byte order mark.
std::string utf16(const std::string& text, bool little) {
  std::string bytes = little ? "\xFF\xFE" : "\xFE\xFF";
  for (const char c : text) bytes += little ? std::string{c, '\0'} : std::string{'\0', c};
  return bytes;
}

TEST_F(SurfaceVariants, TextInUtf16) {
  const std::string obj = "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\ng wall\r\nf 1 2 3\r\n";
  for (const bool little : {true, false}) {
    EXPECT_EQ(surface(utf16(obj, little), "a.obj").names.facets.begin()->second, "wall");
    EXPECT_EQ(
        surface(utf16("solid x\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                      "endloop\nendfacet\nendsolid x\n",
                      little),
                "a.stl")
            .facets.size(),
        1u);
    EXPECT_EQ(error(utf16("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 5\n", little), "a.off").substr(0, 7),
              "line 6:");
  }
  // Names beyond ASCII, and beyond 16 bits.
  const std::string name = utf16("g ", true) + std::string("\xE9\x00\xAC\x20\x3D\xD8\x00\xDE", 8);
  EXPECT_EQ(surface(utf16("v 0 0 0\nv 1 0 0\nv 0 1 0\n", true) + name.substr(2) +
                        utf16("\nf 1 2 3\n", true).substr(2),
                    "a.obj")
                .names.facets.begin()
                ->second,
            "\u00E9\u20AC\U0001F600");
  // A header of a binary file may begin with these bytes, too.
  EXPECT_EQ(surface(binary_stl("\xFF\xFE", {{0, 0, 0, 1, 0, 0, 0, 1, 0}}), "a.stl").facets.size(), 1u);
}

TEST_F(SurfaceVariants, FreeFormsOfObj) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n",
                    curve = "cstype bezier\ncurv 0 1 1 2 \\\n 3\nend\n";
  const Surface face = surface(points + curve + "f 1 2 3\nsurf 0 1 0 1 1 2 3\n", "a.obj");
  EXPECT_EQ(face.facets.size(), 1u);
  EXPECT_TRUE(std::any_of(face.remarks.begin(), face.remarks.end(), [](const Remark& remark) {
    return remark.message == "2 free-form curves and surfaces are left out";
  }));
  EXPECT_EQ(
      error(points + curve, "a.obj"),
      "line 5: free-form curves and surfaces are not read, and there are no faces besides; export them as "
      "triangles");
}

TEST_F(SurfaceVariants, OffThatTellsItsDimensions) {
  const std::string behind = "\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(surface("nOFF\n3" + behind, "a.off").facets, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(surface("nOFF 3" + behind, "a.off").facets.size(), 1u);
  EXPECT_EQ(error("nOFF\n4" + behind, "a.off"), "line 2: only OFF of three dimensions is read");
  EXPECT_EQ(error("4nOFF\n3" + behind, "a.off"), "line 1: '4nOFF' is not OFF of three dimensions");
  EXPECT_EQ(error("4OFF" + behind, "a.off"), "line 1: '4OFF' is not OFF of three dimensions");
  EXPECT_EQ(surface("NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n", "a.off").facets.size(),
            1u);
}

TEST_F(SurfaceVariants, PlyWhoseCountsAreTooSmall) {
  const std::string head =
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar uchar vertex_indices\nend_header\n";
  const std::string text = "ply\nformat ascii 1.0\n" + head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(surface(text + "\n \n", "a.ply").facets.size(), 1u);
  EXPECT_EQ(error(text + "3 0 2 1\n", "a.ply"), "line 14: text after the last element; the counts are wrong");
  std::string binary = "ply\nformat binary_little_endian 1.0\n" + head + std::string(36, '\0');
  binary[binary.size() - 36 + 15] = binary[binary.size() - 36 + 28] = '?';
  binary += std::string("\3\0\1\2", 4);
  EXPECT_EQ(surface(binary, "a.ply").facets.size(), 1u);
  EXPECT_EQ(surface(binary + "\r\n", "a.ply").facets.size(), 1u);
  EXPECT_EQ(error(binary + '\3', "a.ply"),
            "byte " + std::to_string(binary.size()) + ": bytes after the last element; the counts are wrong");
}

TEST_F(SurfaceVariants, StlWhoseHeaderDoesNotKnowTheNumber) {
  const std::string whole =
      binary_stl("written as it comes", {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 0, 0, 0, 1, 0, 0, 0, 1}});
  for (const std::string& number : {std::string(4, '\0'), std::string(4, '\xFF')}) {
    std::string text = whole;
    text.replace(80, 4, number);
    const Surface s = surface(text, "a.stl");
    EXPECT_EQ(s.facets, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
    ASSERT_EQ(s.remarks.size(), 1u);
    EXPECT_NE(s.remarks[0].message.find("triangles: the 2 that follow are read"), std::string::npos);
    EXPECT_NE(error(text.substr(0, text.size() - 1), "a.stl"), "read");
  }
  std::string one = whole;
  one[80] = 1;
  EXPECT_EQ(error(one, "a.stl"), "byte 84: the header announces 1 triangle, but 50 more bytes follow it");
  EXPECT_EQ(error(whole.substr(0, 80) + std::string(4, '\0'), "a.stl"), "the file holds no vertices");
}

TEST_F(SurfaceVariants, BinaryStlOfSeveralSolids) {
  const std::string one = binary_stl("one", {{0, 0, 0, 1, 0, 0, 0, 1, 0}});
  const std::string two = binary_stl("two", {{0, 0, 0, 0, 1, 0, 0, 0, 1}, {5, 0, 0, 6, 0, 0, 5, 1, 0}});
  const Surface s = surface(one + two, "a.stl");
  EXPECT_EQ(s.facets, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(s.facet_markers, (std::vector<int>{1, 2, 2}));
  EXPECT_TRUE(s.remarks.empty());
  EXPECT_EQ(error(one + two + "more", "a.stl"),
            "byte 84: the header announces 1 triangle, but 188 more bytes follow it");
  EXPECT_EQ(error(one + two.substr(0, two.size() - 1), "a.stl"),
            "byte 84: the header announces 1 triangle, but 183 more bytes follow it");
}

TEST_F(SurfaceVariants, ColoursOfVerticesInObj) {
  const Surface s = surface("v 0 0 0 1 0.5 0\nv 1 0 0 2\nv 0 1 0 1.0\nf 1 2 3\n", "a.obj");
  EXPECT_EQ(s.facets.size(), 1u);
  ASSERT_EQ(s.remarks.size(), 1u);
  EXPECT_EQ(s.remarks[0].message, "2 colours or weights of vertices are left out");
}

TEST_F(SurfaceVariants, BinaryOffAsOpenMeshWritesIt) {
  std::string bytes = "OFF BINARY\n";
  for (const std::uint32_t count : {3, 2, 0}) io::store(bytes, count, std::endian::little);
  for (const float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F})
    io::store(bytes, x, std::endian::little);
  for (const std::uint32_t n : {3, 0, 1, 2, 3, 2, 1, 0}) io::store(bytes, n, std::endian::little);
  const Surface s = surface(bytes, "a.off");
  EXPECT_EQ(s.vertices, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(s.facets, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 0}}));
  EXPECT_NE(error(bytes + "more", "a.off").find("bytes after the last of 2 faces"), std::string::npos);
}

TEST_F(SurfaceVariants, IntegersOf64BitsInPly) {
  const std::string head =
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty int64 marker\n"
      "element face 1\nproperty list uint8 uint64 vertex_indices\nend_header\n";
  const Surface text =
      surface("ply\nformat ascii 1.0\n" + head + "0 0 0 7\n1 0 0 8\n0 1 0 9\n3 0 1 2\n", "a.ply");
  EXPECT_EQ(text.facets, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(text.vertex_markers, (std::vector<int>{7, 8, 9}));
  std::string bytes = "ply\nformat binary_little_endian 1.0\n" + head;
  for (const int i : {0, 1, 2}) {
    for (const float x : {i == 1 ? 1.F : 0.F, i == 2 ? 1.F : 0.F, 0.F})
      io::store(bytes, x, std::endian::little);
    io::store(bytes, std::int64_t{7} + i, std::endian::little);
  }
  bytes += '\3';
  for (const std::uint64_t v : {0, 1, 2}) io::store(bytes, v, std::endian::little);
  const Surface binary = surface(bytes, "a.ply");
  EXPECT_EQ(binary.vertices, text.vertices);
  EXPECT_EQ(binary.facets, text.facets);
  EXPECT_EQ(binary.vertex_markers, text.vertex_markers);
}

TEST_F(SurfaceVariants, FacesBeforeVerticesInPly) {
  const std::string head = "ply\nformat ascii 1.0\n",
                    faces = "element face 1\nproperty list int int vertex_indices\n",
                    vertices = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  EXPECT_EQ(
      error(head + faces + vertices + "end_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n", "a.ply"),
      "line 3: the element 'face' comes before the vertices, which is not supported: save vertices first");
  EXPECT_EQ(
      surface(head + vertices + faces + "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a.ply").facets.size(),
      1u);
}

// VTK writes arrays of strings and bits: a binary string after its length, text strings one per line.
TEST_F(SurfaceVariants, LegacyVtkArraysOfStringsAndBitsAreLeftOut) {
  const auto told = [&](const std::string& bytes) {
    const Surface s = surface(bytes, "a.vtk");
    EXPECT_EQ(s.facets, (std::vector<Triangle>{{0, 2, 1}}));
    return s.remarks.empty() ? "" : s.remarks[0].message;
  };
  const std::string text = std::string(kVtk).substr(0, std::string(kVtk).find("CELL_DATA"));
  const std::string arrays =
      "\nPOINT_DATA 4\nFIELD F 2\nnames 1 4 string\na%20b\n\n3 4\nd\nflags 1 4 bit\n0 1 1 0\n";
  EXPECT_EQ(told(text + arrays), "2 arrays ('names', 'flags') are left out");
  EXPECT_EQ(told(text + "\nPOINT_DATA 4\nPEDIGREE_IDS ids string\na\nb\nc\nd\n"),
            "1 array ('ids') is left out");
  EXPECT_EQ(error(text + "\nPOINT_DATA 4\nPEDIGREE_IDS ids string\na\nb\nc\n", "a.vtk").substr(0, 8),
            "line 28:");

  const std::string whole = binary_vtk();
  const std::string head =
      whole.substr(0, whole.find("\nCELL_DATA")) + "\nPOINT_DATA 4\nFIELD F 2\nnames 1 5 string\n";
  const std::string strings = std::string("\xC0\xC2\n\n\x81\0", 6) + std::string(256, 'x') +
                              std::string("\x40\0\0\1y\0\0\0\0\0\0\0\2zz", 15);
  EXPECT_EQ(told(head + strings + "\nflags 1 4 bit\n\x60\n"), "2 arrays ('names', 'flags') are left out");
  for (const std::size_t length : {0, 2, 5, 200, 264, 270, 276})
    EXPECT_NE(error(head + strings.substr(0, length), "a.vtk"), "read") << length;
}

TEST_F(SurfaceVariants, ArraysOfStringsInVtuAreTold) {
  const std::string array = "<Array type=\"String\" Name=\"marker\" format=\"ascii\">97 0 0 98 0</Array>";
  const Surface s = surface(replaced(kVtu, "<CellData>", "<CellData>" + array), "a.vtu");
  EXPECT_EQ(s.facet_markers, surface(kVtu, "a.vtu").facet_markers);
  EXPECT_NE(s.remarks[0].message.find("'marker'"), std::string::npos) << s.remarks[0].message;
}

}  // namespace
}  // namespace holdfast::io_surface_variants_test
