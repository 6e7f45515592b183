// Meshes of legacy DOLFIN.
#include <gtest/gtest.h>

#include "io_volumes.h"

namespace holdfast::io_dolfin_test {
namespace {

using namespace samples;

std::string dolfin(const std::string& contents, const std::string& type = "tetrahedron") {
  return "<?xml version=\"1.0\"?>\n<dolfin xmlns:dolfin=\"http://fenicsproject.org\">\n<mesh celltype=\"" +
         type + "\" dim=\"3\">\n" + contents + "</mesh>\n</dolfin>\n";
}
const std::string kVertices =
    "<vertices size=\"5\">\n<vertex index=\"0\" x=\"0\" y=\"0\" z=\"0.0e+00\"/>\n<vertex index=\"1\" x=\"1\" "
    "y=\"0\" z=\"0\"/>\n"
    "<vertex index=\"2\" x=\"0\" y=\"1\" z=\"0\"/>\n<vertex index=\"3\" x=\"0\" y=\"0\" z=\"1\"/>\n"
    "<vertex index=\"4\" x=\"0\" y=\"0\" z=\"-1\"/>\n</vertices>\n";
const std::string kCells =
    "<cells size=\"2\">\n<tetrahedron index=\"0\" v0=\"0\" v1=\"1\" v2=\"2\" v3=\"3\"/>\n"
    "<tetrahedron index=\"1\" v0=\"0\" v1=\"1\" v2=\"2\" v3=\"4\"/>\n</cells>\n";
std::string values(int dimension, const std::string& all) {
  return "<mesh_value_collection name=\"m\" type=\"uint\" dim=\"" + std::to_string(dimension) +
         "\" size=\"1\">\n" + all + "</mesh_value_collection>\n";
}
std::string value(int cell, int entity, int value) {
  return "<value cell_index=\"" + std::to_string(cell) + "\" local_entity=\"" + std::to_string(entity) +
         "\" value=\"" + std::to_string(value) + "\" />\n";
}

TEST(DolfinFile, DomainsOfAllDimensions) {
  const Volume read = volume(dolfin(kVertices + kCells + "<data/><domains>\n" + values(3, value(1, 0, 8)) +
                                    values(2, value(0, 0, 5) + value(1, 0, 6)) + values(1, value(1, 0, 4)) +
                                    values(0, value(0, 3, 7)) + "</domains>\n"),
                             "a.xml");
  // The second tetrahedron, whose corners are in the order of their numbers, is reversed.
  EXPECT_EQ(read.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}, {0, 2, 1, 4}}));
  EXPECT_EQ(read.regions, (std::vector<int>{0, 8}));
  EXPECT_EQ(read.facets, (std::vector<Triangle>{{1, 2, 3}, {2, 1, 4}}));
  EXPECT_EQ(read.facet_markers, (std::vector<int>{5, 6}));
  EXPECT_EQ(read.segments, (std::vector<Segment>{{2, 4}}));
  EXPECT_EQ(read.segment_markers, (std::vector<int>{4}));
  EXPECT_EQ(read.vertex_markers, (std::vector<int>{0, 0, 0, 7, 0}));
}

TEST(DolfinFile, TrianglesAreASurface) {
  const TemporaryFolder folder;
  put(folder / "a.xml",
      dolfin(kVertices +
                 "<cells size=\"1\"><triangle index=\"0\" v0=\"0\" v1=\"1\" v2=\"2\"/></cells><domains>" +
                 values(2, value(0, 0, 3)) + values(1, value(0, 1, 9)) + "</domains>",
             "triangle"));
  const Surface read = read_surface(folder / "a.xml");
  EXPECT_EQ(read.facets, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(read.facet_markers, (std::vector<int>{3}));
  EXPECT_EQ(read.segments, (std::vector<Segment>{{0, 2}}));
}

TEST(DolfinFile, ErrorsNameTheLine) {
  EXPECT_EQ(error("<VTKFile></VTKFile>", "a.xml"),
            "line 1: no mesh of DOLFIN: it does not begin with <dolfin>");
  EXPECT_EQ(error("<dolfin><mesh celltype=\"hexahedron\"/></dolfin>", "a.xml"),
            "line 1: cells of the type 'hexahedron' are not read");
  EXPECT_EQ(error("<dolfin></dolfin>", "a.xml"), "the file has no mesh");
  EXPECT_EQ(error("<dolfin><mesh celltype=\"triangle\">", "a.xml"),
            "does not end with </dolfin>; it is truncated or not DOLFIN's");
  const auto with = [](const std::string& more) { return error(dolfin(kVertices + kCells + more), "a.xml"); };
  EXPECT_EQ(with("<vertex index=\"4\" x=\"0\" y=\"0\" z=\"0\"/>"), "the vertex 4 occurs twice");
  EXPECT_EQ(with("<tetrahedron index=\"2\" v0=\"0\" v1=\"1\" v2=\"2\" v3=\"9\"/>"),
            "line 15: the vertex 9 does not exist");
  EXPECT_EQ(with("<triangle index=\"2\" v0=\"0\" v1=\"1\" v2=\"2\"/>"),
            "line 15: a <triangle> among cells of another type");
  EXPECT_EQ(with("<domains>" + values(2, value(2, 0, 1)) + "</domains>"),
            "line 16: the cell 2 does not exist");
  EXPECT_EQ(with("<domains>" + values(2, value(1, 4, 1)) + "</domains>"),
            "line 16: a cell has no entity 4 of dimension 2");
  EXPECT_EQ(with("<domains>" + values(7, value(1, 0, 1)) + "</domains>"),
            "line 16: a cell has no entity 0 of dimension 4");
}

TEST(DolfinFile, EverythingButNamesComesBack) {
  const TemporaryFolder folder;
  Volume original;
  original.vertices = {{0, 0, 0}, {1, -0.0, 0}, {0, 1, 0}, {0, 0, 1}, {0.1, 0.2, -1.0 / 3}};
  original.tetrahedra = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  original.regions = {20, 3};
  original.facets = {{0, 1, 3}, {0, 2, 1}, {2, 1, 4}};
  original.facet_markers = {0, 7, -4};
  original.segments = {{4, 1}, {3, 4}};
  original.segment_markers = {6, 1};
  original.vertex_markers = {0, 0, 0, 2, 9};
  original.names.facets = {{7, "between"}};
  write_volume(folder / "a.xml", original);
  const Volume read = read_volume(folder / "a.xml");
  EXPECT_EQ(bits(read.vertices), bits(original.vertices));
  EXPECT_EQ(read.tetrahedra, original.tetrahedra);
  EXPECT_EQ(read.regions, original.regions);
  EXPECT_EQ(read.facets, (std::vector<Triangle>{{0, 1, 3}, {0, 2, 1}, {2, 1, 4}}));
  EXPECT_EQ(read.facet_markers[1], 7);
  EXPECT_EQ(read.segments, (std::vector<Segment>{{1, 4}}));
  EXPECT_EQ(read.segment_markers, (std::vector<int>{6}));
  EXPECT_EQ(read.vertex_markers, original.vertex_markers);
  std::string told;
  for (const Remark& remark : not_held(folder / "a.xml", original)) told += remark.message + "\n";
  EXPECT_NE(told.find("1 name has no place in .xml"), std::string::npos) << told;
  EXPECT_NE(told.find("1 segments of no cell have no place in .xml"), std::string::npos) << told;
}

}  // namespace
}  // namespace holdfast::io_dolfin_test
